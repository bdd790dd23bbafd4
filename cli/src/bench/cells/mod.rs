//! `occlusion bench cells`: view cells as they are computed and as they are stored, and what others do.

mod points;
mod report;
#[cfg(feature = "embree")]
mod sampling;
mod score;
mod size;
mod stored;
mod trial;
mod umbra;
mod way;
mod window;

use clap::Args;
use clap::builder::RangedU64ValueParser;
use fastrand::Rng;
use postgres::Client;

use crate::bench::format::Format;
use crate::bench::table::Table;
use crate::database::Database;
use crate::failure::{EXIT_STATUS, Failure};
use crate::terminal::{self, BAD, grouped};
use stored::Stored;
use umbra::Umbra;
use way::{Eroding, Way};
use window::Window;

const EXAMPLES: &str = "Examples:
  occlusion bench cells city --database postgresql://me@localhost/scratch
  occlusion bench cells delft town --cells 40 --format markdown
  occlusion bench cells city --edge 4 --range 300 --window 500";

/// Measures view cells, and their rivals
///
/// Cells are around random places of the streets in a square window in the middle of each scene. Their sets are
/// computed in this program, on one thread, from what is read of the scene: as the database computes them, and by
/// their rivals, which take turns. The rivals: one erosion of all that is around, of a cell that is not divided; and the
/// features in range without those that a single other one hides from all of the cell, by its umbra. A set is held
/// against the union of what is seen from a dense grid of points in its cell.
///
/// Built with the feature "embree", it also samples: item buffers of Embree from a grid of eyes in the cell. It
/// says of every way what it misses of the features that exact rays meet. A set that misses something, and should not, ends it with
/// status 1.
///
/// Of scenes with view cells (occlusion generate --cells) it also measures what queries take, and what the cells
/// take on disk beside a plain table of cell and feature, in a schema occlusion_bench_cells, which it drops, also when it was there before.
/// "make bench-cells" makes the scenes.
#[derive(Args, Debug)]
#[command(after_help = format!("{EXAMPLES}\n\n{EXIT_STATUS}"))]
pub struct Cells {
    /// Scenes with streets
    #[arg(required = true, value_name = "SCENE")]
    scenes: Vec<String>,
    /// Edge of the cells, metres; may be given several times
    #[arg(long = "edge", value_name = "METRES", default_values_t = [4.0, 8.0, 16.0],
          value_parser = metres)]
    edges: Vec<f64>,
    /// Different cells of each size
    #[arg(long, value_name = "N", default_value_t = 20,
          value_parser = RangedU64ValueParser::<usize>::new().range(1..=100_000))]
    cells: usize,
    /// How far eyes see, metres
    #[arg(long, value_name = "METRES", default_value_t = 500.0, value_parser = metres)]
    range: f64,
    /// Edge of the window, metres
    #[arg(long, value_name = "METRES", default_value_t = 1000.0, value_parser = metres)]
    window: f64,
    /// Half edge of the smallest parts of a cell that are told apart, metres
    #[arg(long, value_name = "METRES", default_value_t = 0.25, value_parser = metres)]
    finest: f64,
    /// Different eyes, and features, of which queries in the database are about
    #[arg(long, value_name = "N", default_value_t = 500,
          value_parser = RangedU64ValueParser::<usize>::new().range(1..=100_000))]
    eyes: usize,
    /// Seed of cells, eyes and features
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// How tables are printed
    #[arg(long, value_enum, default_value_t = Format::Plain)]
    format: Format,
    #[command(flatten)]
    database: Database,
}

/// A length that makes sense here.
fn metres(text: &str) -> Result<f64, String> {
    let length = text.parse().ok();
    length
        .filter(|length| (0.05..=1e6).contains(length))
        .ok_or_else(|| "it is between 0.05 and 1000000 metres".to_owned())
}

impl Cells {
    /// Runs the command; whether no set that claims to be complete lacks something visible.
    pub fn run(&self) -> Result<bool, Failure> {
        let mut client = self.database.connect()?;
        #[cfg(not(feature = "embree"))]
        anstream::eprintln!("built without Embree: sampling, and what is missed, are left out");
        let mut is_sound = true;
        for scene in &self.scenes {
            let spinner = terminal::spinner("reading the window");
            let margin = self.edges.iter().copied().fold(0.0, f64::max);
            let window = Window::load(&mut client, scene, self.window, margin, self.range)?;
            spinner.finish_and_clear();
            is_sound &= self.compute(scene, &window)?;
            if let Some(stored) = Stored::find(&mut client, scene)? {
                self.ask(&mut client, scene, &window, &stored)?;
            }
        }
        Ok(is_sound)
    }

    /// Measures ways to compute sets, for each size of cells.
    fn compute(&self, scene: &str, window: &Window) -> Result<bool, Failure> {
        #[cfg(feature = "embree")]
        let scenery = sampling::Scenery::new(window);
        #[cfg(feature = "embree")]
        let mut rays = scenery.known()?;
        let mut is_sound = true;
        for &edge in &self.edges {
            let mut ways: Vec<Box<dyn Way + '_>> = vec![
                Box::new(Eroding::new("view cell", window, edge, self.finest)),
                Box::new(Eroding::new("one erosion", window, edge, f64::INFINITY)),
                Box::new(Umbra::new(window)),
            ];
            #[cfg(feature = "embree")]
            ways.extend(scenery.ways());
            #[cfg(feature = "embree")]
            let mut known = |cell: &engine::Box3d| Some(rays.visible(cell));
            #[cfg(not(feature = "embree"))]
            let mut known = |_: &engine::Box3d| None;
            let cells = window.cells(edge, self.cells, &mut Rng::with_seed(self.seed));
            let bar = terminal::bar(cells.len(), "cells");
            let trial = trial::run(window, &cells, &mut ways, &mut known, &bar);
            bar.finish_and_clear();
            for fault in &trial.false_occlusions {
                anstream::eprintln!("{BAD}false occlusion:{BAD:#} {fault}");
            }
            is_sound &= trial.false_occlusions.is_empty();
            let title = format!("{scene}, cells of {edge} m, {} m", self.range);
            self.print(&title, &trial.table(window.count(edge)));
        }
        Ok(is_sound)
    }

    /// Measures queries, and sizes.
    fn ask(
        &self,
        client: &mut Client,
        scene: &str,
        window: &Window,
        stored: &Stored,
    ) -> Result<(), Failure> {
        let spinner = terminal::spinner("asking");
        let mut rng = Rng::with_seed(self.seed);
        let queries = stored.ask(client, scene, window, self.eyes, &mut rng)?;
        spinner.finish_and_clear();
        let count = grouped(usize::try_from(stored.count).unwrap_or_default());
        let title = format!("{scene}, {count} view cells, {} m", stored.range);
        self.print(&title, &queries);
        let sizes = size::compare(client, scene)?;
        println!("{}\n", sizes.text(self.format));
        Ok(())
    }

    fn print(&self, title: &str, table: &Table) {
        println!("{}", self.format.title(title));
        println!("{}\n", table.text(self.format));
    }
}
