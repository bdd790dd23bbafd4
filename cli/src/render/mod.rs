//! `occlusion render`: a picture of an answer.

mod cells;
mod columns;
mod picture;
mod size;

use std::path::PathBuf;

use clap::Args;
use postgres::Client;
use renderer::{Image, Renderer, View, plan};

use crate::database::Database;
use crate::failure::{EXIT_STATUS, Failure};
use crate::field_of_view::FieldOfView;
use crate::scene::{self, Scene};
use crate::terminal;
use picture::observer;
use size::Size;

/// Written out, since an observer is needed except with `--cells`.
const USAGE: &str = "occlusion render [OPTIONS] --observer <X,Y,Z> <SCENE>
       occlusion render [OPTIONS] --cells [--feature <FEATURE>] <SCENE>";

const EXAMPLES: &str = "Examples:
  occlusion render delft --observer 85200,446800,1.7 --heading 45 --angle 90 -o street.png
  occlusion render delft --observer 85200,446800,1.7 --range 300 --plan -o plan.png
  occlusion render delft --observer 85200,446800,1.7 --heading 45 --angle 90 --above
  occlusion render delft --observer 84738,446786,1.7 --range 24 --columns -o columns.png
  occlusion render delft --cells -o cells.png
  occlusion render delft --cells --observer 85200,446800,0 --range 300 -o quarter.png
  occlusion render delft --cells --feature 815 -o seen-from.png";

/// Draws what an observer sees, or maps of view cells
///
/// Green: in the answer, and truly visible. Blue: in the answer, although hidden. Red: in the field
/// of view, and left out of the answer as hidden. Grey: outside the field of view. With --columns,
/// orange: the solid columns, which hide what is behind them, inside transparent buildings; purple:
/// those that are not grounded.
///
/// With --cells, a map of the view cells, each in the colour of how many features may be seen from
/// it, dark where few and light where many; with --feature too, from where that feature is seen.
#[derive(Args, Debug)]
#[command(
    override_usage = USAGE,
    after_help = format!("{EXAMPLES}\n\n{EXIT_STATUS}"),
    mut_arg("observer", |observer| observer.required(false).required_unless_present("cells"))
)]
pub struct Render {
    /// Scene
    scene: String,
    #[command(flatten)]
    field_of_view: Option<FieldOfView>,
    /// Draw a map instead of what the observer sees
    #[arg(long, conflicts_with = "above")]
    plan: bool,
    /// Look over the observer's shoulder from the air
    #[arg(long)]
    above: bool,
    /// Look from the air at what hides: the solid columns of the features in the field of view.
    /// Needs no occlusion volumes
    #[arg(long, conflicts_with_all = ["plan", "above", "truth"])]
    columns: bool,
    /// Draw a map of the view cells: how many features may be seen from each. The whole scene, or
    /// what is in range of --observer
    #[arg(
        long,
        conflicts_with_all = ["heading", "plan", "above", "columns", "truth"]
    )]
    cells: bool,
    /// From which view cells this feature, by number or name, may be seen
    #[arg(long, value_name = "FEATURE", requires = "cells")]
    feature: Option<String>,
    /// Colour by what is truly visible alone, whatever the answer is
    #[arg(long)]
    truth: bool,
    /// Pixels across and down
    #[arg(long, value_name = "WxH", default_value = "1600x1000")]
    size: Size,
    /// Title of the picture instead of the scene's name
    #[arg(long, value_name = "TEXT")]
    caption: Option<String>,
    /// File to write; without it NAME.png
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    database: Database,
}

impl Render {
    /// Runs the command.
    pub fn run(&self) -> Result<(), Failure> {
        let mut client = self.database.connect()?;
        let drawing = terminal::spinner("drawing");
        let scene = scene::load(&mut client, &self.scene)?;
        let image = match &self.field_of_view {
            Some(field) if !self.cells => self.view(&mut client, &scene, field)?,
            window => self.cell_map(&mut client, &scene, window.as_ref())?,
        };
        let path = self
            .output
            .clone()
            .unwrap_or_else(|| format!("{}.png", self.scene).into());
        image.write_png(&path)?;
        drawing.finish_and_clear();
        println!("{}", path.display());
        Ok(())
    }

    /// What an observer sees, or what hides there.
    fn view(
        &self,
        client: &mut Client,
        scene: &Scene,
        field: &FieldOfView,
    ) -> Result<Image, Failure> {
        let renderer = Renderer::new()?;
        let Size { width, height } = self.size;
        if self.columns {
            let picture = self.solids(client, scene, field)?;
            let view = View::from_above(&picture, width, height);
            return Ok(renderer.columns(&picture, &view)?);
        }
        let picture = self.picture(client, scene, field, &renderer)?;
        if self.plan {
            return Ok(plan(&picture, &self.plan_view(&picture, field))?);
        }
        let view = match self.above {
            true => View::from_above(&picture, width, height),
            false => pitched(View::from_observer(&observer(field), width, height), field),
        };
        Ok(renderer.perspective(&picture, &view)?)
    }
}

/// The view, turned up or down if that was asked for.
fn pitched(view: View, field: &FieldOfView) -> View {
    let pitch = field.pitch.to_radians();
    if pitch == 0.0 {
        return view;
    }
    let target = [0, 1].map(|axis| {
        let ahead = view.target[axis] - view.eye[axis];
        view.eye[axis] + ahead * pitch.cos()
    });
    View {
        target: [target[0], target[1], view.eye[2] + pitch.sin()],
        ..view
    }
}
