//! Runs what the documentation shows: every `sql` block of README.md and of the pages in `docs/`,
//! page by page, the blocks of a page in order and in one fresh database.
//!
//! How a fence asks for more than "runs without an error":
//! - a fence of `text` right after a block holds the rows of the block's last statement, as psql
//!   prints them;
//! - `sql error 42809` says that the block's last statement fails with that SQLSTATE.
//!
//! A statement ends with a line that ends with `;`, outside `$$`.
//!
//! Each query that asks an indexed column of boxes is planned as well, under the server's own
//! settings: on a table that is worth an index it must be answered by one.

use std::fs;
use std::path::{Path, PathBuf};

use end_to_end::TestDatabase;
use postgres::{Client, SimpleQueryMessage};
use serde_json::Value;

/// Operators of the extension that an index of boxes answers in a condition.
const INDEXABLE: [&str; 3] = ["&&", "@>", "<@"];

/// A table of fewer pages than this is read as fast without an index.
const SMALL_TABLE: i64 = 8;

/// A condition that keeps more than this share of the rows is not worth an index.
const SELECTIVE: f64 = 0.1;

/// One block of SQL.
struct Block {
    line: usize,
    statements: Vec<String>,
    /// The SQLSTATE that its last statement must fail with.
    error: Option<String>,
    /// The rows that its last statement must return, the column names first.
    rows: Option<Vec<Vec<String>>>,
}

/// A fence: where it starts, how far to the right, the words after its ticks, and what is in it.
struct Fence {
    line: usize,
    indent: usize,
    words: Vec<String>,
    body: Vec<String>,
}

#[test]
fn every_statement_of_the_documentation_runs() {
    let mut faults = Vec::new();
    let (mut statements, mut indexed) = (0, 0);
    for page in pages() {
        let text = fs::read_to_string(&page).expect("the page is text");
        let blocks = blocks(&text);
        statements += blocks.iter().map(|b| b.statements.len()).sum::<usize>();
        if blocks.is_empty() {
            continue;
        }
        let name = page.file_name().expect("a page has a name");
        let name = name.to_string_lossy();
        let mut database = TestDatabase::new(&name);
        for block in &blocks {
            match run(&mut database.client, block) {
                Ok(scans) => indexed += scans,
                Err(fault) => faults.push(format!("{name}, line {}: {fault}", block.line)),
            }
        }
    }
    assert!(statements > 20, "only {statements} statements were found");
    assert!(indexed > 4, "only {indexed} scans of an index were planned");
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn blocks_are_found_with_what_they_claim() {
    let page = "\n```sql\nSELECT 1\n  AS a;\n-- twice; thrice\nSELECT 2;\n```\n\n```text\n a | b\n---+---\n 2 |\n(1 row)\n```\n\
                ```sql error 22012\nDO $$ BEGIN\n  PERFORM 1;\nEND $$;\nSELECT 1 / 0;\n```\n```\nnot SQL;\n```\n";
    let found = blocks(page);
    assert_eq!(found.len(), 2);
    assert_eq!(found[0].statements.len(), 2);
    assert_eq!(
        found[0].rows,
        Some(vec![
            vec!["a".to_owned(), "b".to_owned()],
            vec!["2".to_owned(), String::new()]
        ])
    );
    assert_eq!(found[1].statements.len(), 2);
    assert_eq!(found[1].error.as_deref(), Some("22012"));
    assert!(found[1].rows.is_none());
}

/// README.md and all pages in `docs/`, in order.
fn pages() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut pages = vec![root.join("README.md")];
    let mut folders = vec![root.join("docs")];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("docs/ is a folder") {
            let path = entry.expect("docs/ can be listed").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "md") {
                pages.push(path);
            }
        }
    }
    pages.sort();
    pages
}

/// The SQL blocks of a page.
fn blocks(page: &str) -> Vec<Block> {
    let fences = fences(page);
    let is_sql = |fence: &Fence| fence.words.first().is_some_and(|word| word == "sql");
    let rows_after = |position: usize| {
        let next: &Fence = fences.get(position + 1)?;
        (next.words == ["text"]).then(|| rows(&next.body))
    };
    let sql = fences.iter().enumerate().filter(|(_, fence)| is_sql(fence));
    sql.map(|(position, fence)| Block {
        line: fence.line,
        statements: statements(&fence.body),
        error: match &fence.words[..] {
            [_, error, state] if error == "error" => Some(state.clone()),
            _ => None,
        },
        rows: rows_after(position),
    })
    .collect()
}

fn fences(page: &str) -> Vec<Fence> {
    let mut fences: Vec<Fence> = Vec::new();
    let mut is_open = false;
    for (number, line) in page.lines().enumerate() {
        let text = line.trim_start();
        match (is_open, text.strip_prefix("```")) {
            (false, Some(words)) => fences.push(Fence {
                line: number + 1,
                indent: line.len() - text.len(),
                words: words.split_whitespace().map(str::to_owned).collect(),
                body: Vec::new(),
            }),
            (true, None) => {
                let fence = fences.last_mut().expect("an open fence");
                let line = line.get(fence.indent..).unwrap_or_default();
                fence.body.push(line.to_owned());
            }
            _ => {}
        }
        is_open ^= text.starts_with("```");
    }
    fences
}

fn statements(lines: &[String]) -> Vec<String> {
    let mut statements = Vec::new();
    let mut current = String::new();
    for line in lines {
        current += line;
        current += "\n";
        let in_body = current.matches("$$").count() % 2 == 1;
        let is_comment = line.trim_start().starts_with("--");
        if line.trim_end().ends_with(';') && !in_body && !is_comment {
            statements.push(std::mem::take(&mut current));
        }
    }
    assert!(
        current.trim().is_empty(),
        "the last statement has no end: {current}"
    );
    statements
}

/// The cells of a table as psql prints it, the column names first.
fn rows(lines: &[String]) -> Vec<Vec<String>> {
    let is_cells =
        |line: &&String| !line.starts_with('(') && line.chars().any(|c| !"-+ ".contains(c));
    lines
        .iter()
        .filter(is_cells)
        .map(|line| line.split('|').map(|cell| cell.trim().to_owned()).collect())
        .collect()
}

/// Runs a block, and says what is not as it claims; returns how many scans of an index its queries
/// are planned with.
fn run(client: &mut Client, block: &Block) -> Result<usize, String> {
    let Some((last, before)) = block.statements.split_last() else {
        return Err("no statement".to_owned());
    };
    let mut scans = 0;
    for statement in before {
        client
            .simple_query(statement)
            .map_err(|error| format!("{statement}{error:?}"))?;
        scans += plan(client, statement)?;
    }
    match (client.simple_query(last), &block.error) {
        (Err(error), Some(state)) if error.code().is_some_and(|code| code.code() == state) => {
            Ok(scans)
        }
        (Err(error), _) => Err(format!("{last}{error:?}")),
        (Ok(_), Some(state)) => Err(format!("{last}does not fail with {state}")),
        (Ok(answer), None) => match &block.rows {
            Some(expected) if *expected != returned(&answer) => {
                Err(format!("{last}returns {:?}", returned(&answer)))
            }
            _ => Ok(scans + plan(client, last)?),
        },
    }
}

/// Plans a statement if it is a query that an index might answer; returns how many scans of an index
/// of boxes there are, or which table it reads though its index would answer.
fn plan(client: &mut Client, statement: &str) -> Result<usize, String> {
    let is_code = |line: &&str| !line.trim_start().starts_with("--");
    let code: Vec<&str> = statement.lines().filter(is_code).collect();
    let code = code.join("\n");
    let code = code.trim_start();
    let query = code.strip_prefix("EXPLAIN (COSTS OFF) ").unwrap_or(code);
    let asks = query.starts_with("SELECT") || query.starts_with("WITH");
    let mut operators = INDEXABLE.iter().chain(&["<->"]);
    if !asks || !operators.any(|operator| query.contains(operator)) {
        return Ok(0);
    }
    let explain = format!("ANALYZE; EXPLAIN (FORMAT JSON, VERBOSE) {query}");
    let answer = client
        .simple_query(&explain)
        .map_err(|error| format!("{explain}{error:?}"))?;
    let text = returned(&answer).swap_remove(1).swap_remove(0);
    let plan: Value = serde_json::from_str(&text).expect("a plan is JSON");
    count_scans(client, &plan[0]["Plan"]).map_err(|why| format!("{query}{why}"))
}

/// Walks a plan.
fn count_scans(client: &mut Client, node: &Value) -> Result<usize, String> {
    let text = |key: &str| node[key].as_str().unwrap_or_default();
    let mut scans = 0;
    match text("Node Type") {
        "Index Scan" | "Index Only Scan" | "Bitmap Index Scan" => {
            let is_ours = INDEXABLE.iter().any(|o| text("Index Cond").contains(o))
                || text("Order By").contains("<->");
            scans += usize::from(is_ours);
        }
        "Seq Scan" if INDEXABLE.iter().any(|o| text("Filter").contains(o)) => {
            let table = format!("{}.{}", text("Schema"), text("Relation Name"));
            let row = client
                .query_one(
                    "SELECT c.relpages::bigint, c.reltuples::float8, EXISTS (
                         SELECT FROM pg_index AS i JOIN pg_opclass AS o ON o.oid = ANY (i.indclass)
                         WHERE i.indrelid = c.oid AND o.opcintype = 'occlusion.box3d'::regtype)
                     FROM pg_class AS c WHERE c.oid = $1::text::regclass",
                    &[&table],
                )
                .map_err(|error| format!("{table}: {error}"))?;
            let (pages, tuples, has_index): (i64, f64, bool) = (row.get(0), row.get(1), row.get(2));
            let kept = node["Plan Rows"].as_f64().unwrap_or(0.0);
            if has_index && pages >= SMALL_TABLE && kept < SELECTIVE * tuples {
                return Err(format!(
                    "reads all {pages} pages of {table} for about {kept} of {tuples} rows"
                ));
            }
        }
        _ => {}
    }
    for child in node["Plans"].as_array().into_iter().flatten() {
        scans += count_scans(client, child)?;
    }
    Ok(scans)
}

/// The cells of an answer, the column names first.
fn returned(answer: &[SimpleQueryMessage]) -> Vec<Vec<String>> {
    let mut table = Vec::new();
    for message in answer {
        match message {
            SimpleQueryMessage::RowDescription(columns) => {
                table.push(columns.iter().map(|c| c.name().to_owned()).collect());
            }
            SimpleQueryMessage::Row(row) => table.push(
                (0..row.len())
                    .map(|i| row.get(i).unwrap_or_default().trim().to_owned())
                    .collect(),
            ),
            _ => {}
        }
    }
    table
}
