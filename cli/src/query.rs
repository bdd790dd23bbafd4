//! `occlusion query`: what an observer sees, as a table.

use std::collections::HashMap;

use clap::Args;
use postgres::Client;
use serde_json::json;

use crate::database::{Database, quoted};
use crate::failure::{EXIT_STATUS, Failure};
use crate::field_of_view::{FieldOfView, Returned};
use crate::terminal::{FAINT, grouped, table};

const EXAMPLES: &str = "Examples:
  occlusion query delft --observer 85200,446800,1.7 --range 100
  occlusion query delft --observer 85200,446800,1.7 --heading 45 --angle 90 --json
  occlusion query delft --observer 85200,446800,1.7 --heading 45 --pitch -5 --fov 60 --aspect 1.5";

/// Lists the features that an observer may see, nearest first
#[derive(Args, Debug)]
#[command(after_help = format!("{EXAMPLES}\n\n{EXIT_STATUS}"))]
pub struct Query {
    /// Scene
    scene: String,
    #[command(flatten)]
    field_of_view: FieldOfView,
    /// Print JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    database: Database,
}

impl Query {
    /// Runs the command.
    pub fn run(&self) -> Result<(), Failure> {
        let mut client = self.database.connect()?;
        let visible = self.field_of_view.visible(&mut client, &self.scene)?;
        let names = self.names(&mut client, &visible)?;
        if self.json {
            let features = visible.iter().map(|feature| {
                json!({
                    "id": feature.id,
                    "name": names.get(&feature.id),
                    "class": feature.class,
                    "distance": feature.distance,
                })
            });
            println!("{:#}", serde_json::Value::from_iter(features));
            return Ok(());
        }
        let row = |feature: &Returned| {
            let name = names
                .get(&feature.id)
                .map(|name| name.escape_debug().to_string());
            vec![
                feature.id.to_string(),
                name.unwrap_or_default(),
                feature.class.clone(),
                format!("{:.1}", feature.distance),
            ]
        };
        let rows: Vec<Vec<String>> = visible.iter().map(row).collect();
        let heading = ["id", "name", "class", "metres"];
        println!("{}", table(&heading, &[true, false, false, true], &rows));
        let total = self.field_of_view.within(&mut client, &self.scene)?.len();
        anstream::println!(
            "{FAINT}{} of the {} features in the field of view{FAINT:#}",
            grouped(visible.len()),
            grouped(total)
        );
        Ok(())
    }

    fn names(
        &self,
        client: &mut Client,
        features: &[Returned],
    ) -> Result<HashMap<i64, String>, Failure> {
        let ids: Vec<i64> = features.iter().map(|feature| feature.id).collect();
        let statement = format!(
            "SELECT id, name FROM {}.feature WHERE id = ANY ($1) AND name IS NOT NULL",
            quoted(&self.scene)
        );
        let rows = client.query(&statement, &[&ids])?;
        Ok(rows.iter().map(|row| (row.get(0), row.get(1))).collect())
    }
}
