//! [`Fault`], mistakes that are planted in a database, to see that the attack finds them.

use clap::ValueEnum;

/// A mistake.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Fault {
    /// Triggers that log edits are disabled
    Trigger,
    /// View cells count whatever was edited since their snapshots
    Snapshot,
    /// What is logged as edited is not read from the tables
    Fill,
    /// Deleted features concern no view cell
    Removal,
}

impl Fault {
    /// Statements that plant it.
    pub fn sql(self, scene: &str) -> String {
        match self {
            Self::Trigger => ["feature", "solid_column", "inner_envelope", "mesh"]
                .map(|table| {
                    format!(
                        "ALTER TABLE {scene}.{table} DISABLE TRIGGER log_edit_before;
                         ALTER TABLE {scene}.{table} DISABLE TRIGGER log_edit_after;"
                    )
                })
                .concat(),
            Self::Snapshot => {
                "CREATE OR REPLACE FUNCTION occlusion.valid_cells_condition(scene text) RETURNS text
                 LANGUAGE sql IMMUTABLE STRICT PARALLEL SAFE AS $$ SELECT 'true' $$"
                    .to_owned()
            }
            Self::Fill => drop_rows(scene, "edit", "true"),
            Self::Removal => drop_rows(scene, "change", "NEW.slot IS NOT NULL"),
        }
    }
}

/// A trigger that keeps rows out of a table.
fn drop_rows(scene: &str, table: &str, condition: &str) -> String {
    format!(
        "CREATE FUNCTION {scene}.forget() RETURNS trigger LANGUAGE plpgsql AS $$ BEGIN RETURN NULL; END $$;
         CREATE TRIGGER forget BEFORE INSERT ON {scene}.{table} FOR EACH ROW WHEN ({condition})
             EXECUTE FUNCTION {scene}.forget()"
    )
}
