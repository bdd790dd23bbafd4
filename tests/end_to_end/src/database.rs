//! Databases of one test.

use postgres::{Client, NoTls};

use crate::{client, database_url};

/// A database with the extension, on the server under test; dropped at the end of its test.
pub struct TestDatabase {
    name: String,
    /// Where it is.
    pub url: String,
    /// A connection to it.
    pub client: Client,
}

impl TestDatabase {
    /// Makes it.
    ///
    /// # Panics
    /// When the server refuses.
    #[must_use]
    pub fn new(test: &str) -> Self {
        // A name that needs no quotes, in SQL and in a URL.
        let name = format!("e2e_{test}_{}", std::process::id()).to_lowercase();
        let name = name.replace(|c: char| !c.is_ascii_alphanumeric(), "_");
        let drop = format!("DROP DATABASE IF EXISTS {name} WITH (FORCE)");
        let create = format!("CREATE DATABASE {name}");
        for statement in [drop, create] {
            let done = client().batch_execute(&statement);
            done.unwrap_or_else(|e| panic!("{statement}: {e:?}"));
        }
        let url = beside(&database_url(), &name);
        let mut client = Client::connect(&url, NoTls).expect("the new database answers");
        client
            .batch_execute("CREATE EXTENSION pg_occlusion")
            .expect("the extension can be made");
        Self { name, url, client }
    }

    /// Whether a statement with one parameter returns a row.
    #[track_caller]
    pub fn finds(&mut self, statement: &str, parameter: &str) -> bool {
        let row = self.client.query_opt(statement, &[&parameter]);
        row.unwrap_or_else(|e| panic!("{statement}: {e:?}"))
            .is_some()
    }
}

impl Drop for TestDatabase {
    fn drop(&mut self) {
        // In a drop: a failure must not hide the one of the test.
        let _ = client().batch_execute(&format!("DROP DATABASE {} WITH (FORCE)", self.name));
    }
}

/// The URL of another database on the same server.
fn beside(url: &str, name: &str) -> String {
    let (before, options) = url.split_at(url.find('?').unwrap_or(url.len()));
    let (server, _) = before.rsplit_once('/').expect("a URL has a path");
    format!("{server}/{name}{options}")
}
