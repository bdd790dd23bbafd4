//! How commands reach the database.

use std::env;
use std::path::Path;

use clap::Args;
use postgres::binary_copy::BinaryCopyInWriter;
use postgres::types::{ToSql, Type};
use postgres::{Client, Config, NoTls, Transaction};

use crate::failure::Failure;

/// Where Debian's servers listen; others use the second.
const SOCKET_FOLDERS: [&str; 2] = ["/var/run/postgresql", "/tmp"];

/// The option that every command has.
#[derive(Args, Clone, Debug)]
pub struct Database {
    /// Database to use, such as postgresql://user@host/name; without it PGHOST, PGPORT, PGUSER,
    /// PGPASSWORD, PGDATABASE and PGOPTIONS say, as for psql
    #[arg(long, value_name = "URL")]
    database: Option<String>,
}

impl Database {
    /// Connects, and makes sure that the extension is there.
    pub fn connect(&self) -> Result<Client, Failure> {
        self.connect_with(self.config()?)
    }

    /// The same; `heed` gets the server's notices.
    pub fn connect_heeding(
        &self,
        heed: impl Fn(&str) + Send + Sync + 'static,
    ) -> Result<Client, Failure> {
        let mut config = self.config()?;
        config.notice_callback(move |notice| heed(notice.message()));
        self.connect_with(config)
    }

    fn connect_with(&self, config: Config) -> Result<Client, Failure> {
        let mut client = config.connect(NoTls)?;
        let installed = "SELECT FROM pg_catalog.pg_extension WHERE extname = 'pg_occlusion'";
        if client.query_opt(installed, &[])?.is_none() {
            let name: String = client
                .query_one("SELECT current_database()::text", &[])?
                .get(0);
            return Err(Failure::Unready(format!(
                "database \"{name}\" has no extension pg_occlusion\n  hint: CREATE EXTENSION pg_occlusion"
            )));
        }
        Ok(client)
    }

    fn config(&self) -> Result<Config, Failure> {
        let url = self.database.as_deref().unwrap_or_default();
        let mut config: Config = url
            .parse()
            .map_err(|error| Failure::Input(format!("\"{url}\" is no database: {error}")))?;
        add_variables(&mut config, |name| env::var(name).ok())?;
        config.application_name("occlusion");
        Ok(config)
    }

    /// The option as it would be repeated in a shell, or nothing. A URL with a password is not
    /// repeated.
    pub fn as_argument(&self) -> String {
        let has_no_password = |url: &&String| {
            url.parse()
                .is_ok_and(|config: Config| config.get_password().is_none())
        };
        let url = self.database.as_ref().filter(has_no_password);
        url.map(|url| format!(" --database {}", shell_word(url)))
            .unwrap_or_default()
    }
}

/// One word of a shell's command line.
pub fn shell_word(text: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-./:".contains(c);
    if !text.is_empty() && text.chars().all(is_plain) {
        return text.to_owned();
    }
    format!("'{}'", text.replace('\'', r"'\''"))
}

/// A variable of libpq, and how it fills what a configuration leaves open.
type Setting = (&'static str, fn(&mut Config, &str));

const SETTINGS: [Setting; 4] = [
    ("PGUSER", |config, user| {
        if config.get_user().is_none() {
            config.user(user);
        }
    }),
    ("PGPASSWORD", |config, password| {
        if config.get_password().is_none() {
            config.password(password);
        }
    }),
    ("PGDATABASE", |config, name| {
        if config.get_dbname().is_none() {
            config.dbname(name);
        }
    }),
    ("PGOPTIONS", |config, options| {
        if config.get_options().is_none() {
            config.options(options);
        }
    }),
];

/// Fills in what the URL leaves open from the variables that libpq reads.
fn add_variables(
    config: &mut Config,
    variable: impl Fn(&str) -> Option<String>,
) -> Result<(), Failure> {
    if config.get_hosts().is_empty() && config.get_hostaddrs().is_empty() {
        match variable("PGHOST").or_else(socket_folder) {
            Some(host) => config.host(&host),
            None => config.host("localhost"),
        };
    }
    if config.get_ports().is_empty()
        && let Some(port) = variable("PGPORT")
    {
        let number = port.parse();
        config.port(number.map_err(|_| Failure::Input(format!("PGPORT \"{port}\" is no port")))?);
    }
    for (name, set) in SETTINGS {
        if let Some(value) = variable(name) {
            set(config, &value);
        }
    }
    Ok(())
}

fn socket_folder() -> Option<String> {
    let holds_socket = |folder: &&str| Path::new(folder).join(".s.PGSQL.5432").exists();
    SOCKET_FOLDERS
        .iter()
        .find(|folder| holds_socket(folder))
        .map(|&folder| folder.to_owned())
}

/// An identifier as SQL text.
pub fn quoted(name: &str) -> String {
    format!("\"{}\"", name.replace('"', "\"\""))
}

/// A text in SQL.
pub fn literal(text: &str) -> String {
    format!("'{}'", text.replace('\'', "''"))
}

/// Rows on their way into a table, by binary COPY.
pub struct Copy<'a>(BinaryCopyInWriter<'a>);

impl<'a> Copy<'a> {
    /// Begins to fill `columns` of `scene.table`.
    pub fn begin(
        transaction: &'a mut Transaction<'_>,
        scene: &str,
        table: &str,
        columns: &str,
    ) -> Result<Self, Failure> {
        let table = format!("{}.{table}", quoted(scene));
        let described = transaction.prepare(&format!("SELECT {columns} FROM {table}"))?;
        let types: Vec<Type> = described
            .columns()
            .iter()
            .map(|column| column.type_().clone())
            .collect();
        let copy = format!("COPY {table} ({columns}) FROM STDIN (FORMAT binary)");
        Ok(Self(BinaryCopyInWriter::new(
            transaction.copy_in(&copy)?,
            &types,
        )))
    }

    /// Sends one row.
    pub fn row(&mut self, values: &[&(dyn ToSql + Sync)]) -> Result<(), Failure> {
        Ok(self.0.write(values)?)
    }

    /// Ends the table.
    pub fn finish(self) -> Result<(), Failure> {
        self.0.finish()?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use postgres::config::Host;

    fn variables(name: &str) -> Option<String> {
        let value = match name {
            "PGHOST" => "/somewhere",
            "PGPORT" => "5433",
            "PGUSER" => "alice",
            "PGDATABASE" => "city",
            _ => return None,
        };
        Some(value.to_owned())
    }

    #[test]
    fn variables_fill_what_the_url_leaves_open() {
        let mut config: Config = "postgresql:///".parse().unwrap();
        add_variables(&mut config, variables).unwrap();
        assert_eq!(config.get_hosts(), [Host::Unix("/somewhere".into())]);
        assert_eq!(
            (config.get_ports(), config.get_user()),
            (&[5433][..], Some("alice"))
        );
        assert_eq!(config.get_dbname(), Some("city"));
    }

    #[test]
    fn the_url_comes_before_the_variables() {
        let url = "postgresql://bob@/town?host=%2Felse%2Fwhere&port=5434";
        let mut config: Config = url.parse().unwrap();
        add_variables(&mut config, variables).unwrap();
        assert_eq!(config.get_hosts(), [Host::Unix("/else/where".into())]);
        assert_eq!(
            (config.get_ports(), config.get_user()),
            (&[5434][..], Some("bob"))
        );
        assert_eq!(config.get_dbname(), Some("town"));
    }

    #[test]
    fn a_port_that_is_none_is_quoted() {
        let refused = add_variables(&mut Config::new(), |name| {
            (name == "PGPORT").then(|| "x".to_owned())
        });
        assert_eq!(refused.unwrap_err().to_string(), "PGPORT \"x\" is no port");
    }

    #[test]
    fn passwords_are_not_repeated() {
        let argument = |url: &str| {
            let database = Some(url.to_owned());
            Database { database }.as_argument()
        };
        assert_eq!(argument("postgresql://a@h/d?x"), "");
        assert_eq!(
            argument("postgresql://a@h/d"),
            " --database 'postgresql://a@h/d'"
        );
        assert_eq!(argument("postgresql://a:secret@h/d"), "");
    }

    #[test]
    fn shell_words_are_quoted_where_they_must_be() {
        assert_eq!(
            ["delft", "it's", ""].map(shell_word),
            ["delft", r"'it'\''s'", "''"]
        );
    }

    #[test]
    fn identifiers_keep_their_quotes() {
        assert_eq!(quoted(r#"a "b""#), r#""a ""b""""#);
    }
}
