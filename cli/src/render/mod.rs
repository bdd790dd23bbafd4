//! `occlusion render`: a picture of an answer.

mod columns;
mod picture;
mod size;

use std::path::PathBuf;

use clap::Args;
use renderer::{Image, PictureScene, Renderer, View, plan};

use crate::database::Database;
use crate::failure::{EXIT_STATUS, Failure};
use crate::field_of_view::FieldOfView;
use crate::scene;
use crate::terminal;
use size::Size;

const EXAMPLES: &str = "Examples:
  occlusion render delft --observer 85200,446800,1.7 --heading 45 --angle 90 -o street.png
  occlusion render delft --observer 85200,446800,1.7 --range 300 --plan -o plan.png
  occlusion render delft --observer 85200,446800,1.7 --heading 45 --angle 90 --above
  occlusion render delft --observer 84738,446786,1.7 --range 24 --columns -o columns.png";

/// Draws what an observer sees
///
/// Green: in the answer, and truly visible. Blue: in the answer, although hidden. Red: in the field
/// of view, and left out of the answer as hidden. Grey: outside the field of view. With --columns,
/// orange: the solid columns, which hide what is behind them, inside transparent buildings; purple:
/// those that are not grounded.
#[derive(Args, Debug)]
#[command(after_help = format!("{EXAMPLES}\n\n{EXIT_STATUS}"))]
pub struct Render {
    /// Scene
    scene: String,
    #[command(flatten)]
    field_of_view: FieldOfView,
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
        let renderer = Renderer::new()?;
        let picture = match self.columns {
            true => self.solids(&mut client, &scene)?,
            false => self.picture(&mut client, &scene, &renderer)?,
        };
        let path = self
            .output
            .clone()
            .unwrap_or_else(|| format!("{}.png", self.scene).into());
        self.image(&picture, &renderer)?.write_png(&path)?;
        drawing.finish_and_clear();
        println!("{}", path.display());
        Ok(())
    }

    fn image(&self, picture: &PictureScene, renderer: &Renderer) -> Result<Image, Failure> {
        let Size { width, height } = self.size;
        if self.plan {
            return Ok(plan(picture, &self.plan_view(picture))?);
        }
        if self.columns {
            let view = View::from_above(picture, width, height);
            return Ok(renderer.columns(picture, &view)?);
        }
        let observer = self.observer();
        let view = match self.above {
            true => View::from_above(picture, width, height),
            false => self.pitched(View::from_observer(&observer, width, height)),
        };
        Ok(renderer.perspective(picture, &view)?)
    }

    /// The view, turned up or down if that was asked for.
    fn pitched(&self, view: View) -> View {
        let pitch = self.field_of_view.pitch.to_radians();
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
}
