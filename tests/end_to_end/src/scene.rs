//! Scenes of one test.

use std::env;

use postgres::{Client, NoTls};

/// The database under test.
///
/// # Panics
/// Without `DATABASE_URL`.
#[must_use]
pub fn database_url() -> String {
    env::var("DATABASE_URL").expect("DATABASE_URL names a database with pg_occlusion")
}

/// A connection to the database under test.
///
/// # Panics
/// When there is none.
#[must_use]
pub fn client() -> Client {
    Client::connect(&database_url(), NoTls).expect("the database answers")
}

/// A scene with a name of its own, dropped at the end of its test.
pub struct TestScene {
    /// Its name.
    pub name: String,
    /// A connection to its database.
    pub client: Client,
}

impl TestScene {
    /// Chooses a name; the scene is not made yet.
    #[must_use]
    pub fn new(test: &str) -> Self {
        let name = format!("e2e {test} {}", std::process::id());
        let mut scene = Self {
            name,
            client: client(),
        };
        scene.drop_if_there();
        scene
    }

    /// Runs statements in which `{s}` stands for the scene's schema.
    #[track_caller]
    pub fn run(&mut self, statements: &str) {
        let statements = self.fill(statements);
        self.client
            .batch_execute(&statements)
            .unwrap_or_else(|e| panic!("{statements}: {e:?}"));
    }

    /// The number that a statement returns.
    #[track_caller]
    pub fn number(&mut self, statement: &str) -> i64 {
        let statement = self.fill(statement);
        let row = self.client.query_one(&statement, &[]);
        row.unwrap_or_else(|e| panic!("{statement}: {e:?}")).get(0)
    }

    /// Whether there is a schema of this name.
    pub fn exists(&mut self) -> bool {
        let statement = "SELECT FROM pg_catalog.pg_namespace WHERE nspname = $1";
        self.client
            .query_opt(statement, &[&self.name])
            .is_ok_and(|row| row.is_some())
    }

    fn fill(&self, statement: &str) -> String {
        statement.replace("{s}", &format!("\"{}\"", self.name))
    }

    fn drop_if_there(&mut self) {
        if self.exists() {
            let drop = "SELECT occlusion.drop_scene($1, force => true)";
            // In a drop: a failure must not hide the one of the test.
            let _ = self.client.execute(drop, &[&self.name]);
        }
    }
}

impl Drop for TestScene {
    fn drop(&mut self) {
        // The connection may be what failed.
        self.client = client();
        self.drop_if_there();
    }
}
