//! `occlusion export`: models as one file.

use std::fs;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use postgres::Client;

use crate::database::{Database, quoted};
use crate::failure::{EXIT_STATUS, Failure};
use crate::field_of_view::FieldOfView;
use crate::terminal::{self, GOOD, grouped};

/// Written out, since of the observer and `--all` just one is needed.
const USAGE: &str = "occlusion export [OPTIONS] --observer <X,Y,Z> --output <FILE> <SCENE>
       occlusion export [OPTIONS] --all --output <FILE> <SCENE>";

const EXAMPLES: &str = "Examples:
  occlusion export delft --observer 85200,446800,1.7 -o visible.glb
  occlusion export delft --observer 85200,446800,1.7 --heading 45 --angle 90 -o street.wrl
  occlusion export delft --all --level-of-detail 1.2 -o delft.city.jsonl";

/// Writes the models of what an observer sees, or of a whole scene, to one file
///
/// The file's name tells the format: .glb, .wrl (VRML97), .city.json, or .city.jsonl
/// (CityJSONSeq).
#[derive(Args, Debug)]
#[command(override_usage = USAGE, after_help = format!("{EXAMPLES}\n\n{EXIT_STATUS}"))]
pub struct Export {
    /// Scene
    scene: String,
    #[command(flatten)]
    field_of_view: Option<FieldOfView>,
    /// Every feature of the scene instead of what an observer sees
    #[arg(
        long,
        conflicts_with = "observer",
        required_unless_present = "observer"
    )]
    all: bool,
    /// File to write
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Format, whatever the file's name is
    #[arg(long, value_name = "FORMAT")]
    format: Option<ModelFormat>,
    /// Best level of detail; without it the best there is
    #[arg(long, value_name = "N")]
    level_of_detail: Option<f64>,
    /// Coarser levels where their error takes at most this angle, degrees
    #[arg(long, value_name = "DEGREES", conflicts_with = "all")]
    error_angle: Option<f64>,
    #[command(flatten)]
    database: Database,
}

/// A format that models are written in.
#[derive(Clone, Copy, Debug, PartialEq, ValueEnum)]
enum ModelFormat {
    /// glTF 2.0 in one binary file
    Glb,
    /// VRML97
    Vrml97,
    /// One CityJSON 2.0 document
    Cityjson,
    /// CityJSONSeq: a feature a line
    Cityjsonseq,
}

impl ModelFormat {
    /// The format that a file's name tells.
    fn of(path: &Path) -> Option<Self> {
        let name = path.file_name()?.to_str()?.to_ascii_lowercase();
        match name.rsplit('.').next()? {
            "glb" => Some(Self::Glb),
            "wrl" | "vrml" => Some(Self::Vrml97),
            "json" => Some(Self::Cityjson),
            "jsonl" => Some(Self::Cityjsonseq),
            _ => None,
        }
    }

    /// Its name in SQL.
    fn name(self) -> &'static str {
        match self {
            Self::Glb => "glb",
            Self::Vrml97 => "vrml97",
            Self::Cityjson => "cityjson",
            Self::Cityjsonseq => "cityjsonseq",
        }
    }
}

/// Which features go into the file.
struct Wanted {
    ids: Vec<i64>,
    /// Metres to each, where there is an observer.
    distances: Option<Vec<f64>>,
}

impl Export {
    /// Runs the command.
    pub fn run(&self) -> Result<(), Failure> {
        let format = self.format.or_else(|| ModelFormat::of(&self.output)).ok_or_else(|| {
            Failure::Input(format!(
                "\"{}\" does not tell a format\n  hint: end it in .glb, .wrl, .city.json or .city.jsonl, or say --format",
                self.output.display()
            ))
        })?;
        let mut client = self.database.connect()?;
        let spinner = terminal::spinner("writing");
        client.execute("SELECT occlusion.require_scene($1)", &[&self.scene])?;
        let wanted = self.wanted(&mut client)?;
        let statement = "SELECT occlusion.merged_models($1, $2, $3, $4, \
                         occlusion.unnoticed_errors($5::float8[], $6))";
        let row = client.query_one(
            statement,
            &[
                &self.scene,
                &wanted.ids,
                &format.name(),
                &self.level_of_detail,
                &wanted.distances,
                &self.error_angle,
            ],
        )?;
        let content: &[u8] = row.get(0);
        fs::write(&self.output, content).map_err(|error| {
            Failure::Machine(format!(
                "cannot write \"{}\": {error}",
                self.output.display()
            ))
        })?;
        spinner.finish_and_clear();
        anstream::println!(
            "{GOOD}wrote{GOOD:#} {} features, {} bytes, to {}",
            grouped(wanted.ids.len()),
            grouped(content.len()),
            self.output.display()
        );
        Ok(())
    }

    fn wanted(&self, client: &mut Client) -> Result<Wanted, Failure> {
        if let Some(field_of_view) = &self.field_of_view {
            let visible = field_of_view.visible(client, &self.scene)?;
            return Ok(Wanted {
                ids: visible.iter().map(|feature| feature.id).collect(),
                distances: Some(visible.iter().map(|feature| feature.distance).collect()),
            });
        }
        let statement = format!("SELECT id FROM {}.feature ORDER BY id", quoted(&self.scene));
        let rows = client.query(&statement, &[])?;
        Ok(Wanted {
            ids: rows.iter().map(|row| row.get(0)).collect(),
            distances: None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_tell_the_format() {
        let format = |name: &str| ModelFormat::of(Path::new(name)).map(ModelFormat::name);
        assert_eq!(format("a/b.GLB"), Some("glb"));
        assert_eq!(format("town.wrl"), Some("vrml97"));
        assert_eq!(format("town.city.json"), Some("cityjson"));
        assert_eq!(format("town.city.jsonl"), Some("cityjsonseq"));
        assert_eq!(
            [format("town"), format("town.obj"), format("..")],
            [None, None, None]
        );
    }
}
