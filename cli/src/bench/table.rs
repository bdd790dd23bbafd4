//! [`Table`], what is compared beside one another.

use super::format::Format;

/// A row for each thing that is compared. All columns but the first hold numbers.
pub struct Table {
    /// What the columns hold.
    pub heading: Vec<&'static str>,
    /// As many cells each.
    pub rows: Vec<Vec<String>>,
    /// Sentences below it.
    pub remarks: Vec<String>,
}

impl Table {
    /// As text.
    pub fn text(&self, format: Format) -> String {
        let right: Vec<bool> = (0..self.heading.len()).map(|column| column > 0).collect();
        let table = format.table(&self.heading, &right, &self.rows);
        format!("{table}\n\n{}\n", self.remarks.join("\n"))
    }
}

/// A number that may not have been measured.
pub fn optional(number: Option<f64>, digits: usize) -> String {
    number.map_or("–".to_owned(), |number| format!("{number:.digits$}"))
}

/// A share, which is "0" only where it is none.
#[cfg(feature = "embree")]
pub fn percent(share: Option<f64>) -> String {
    match share {
        Some(0.0) => "0".to_owned(),
        Some(share) => format!("{:.2} %", 100.0 * share),
        None => optional(None, 2),
    }
}
