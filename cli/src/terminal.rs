//! What goes to the terminal while a command runs.

use std::time::Duration;

use anstyle::{AnsiColor, Style};
use indicatif::{ProgressBar, ProgressStyle};

/// Good news.
pub const GOOD: Style = AnsiColor::Green.on_default().bold();
/// Bad news.
pub const BAD: Style = AnsiColor::Red.on_default().bold();
/// What matters less.
pub const FAINT: Style = Style::new().dimmed();

/// A progress bar on standard error; invisible where that is no terminal.
pub fn bar(total: usize, task: &'static str) -> ProgressBar {
    let style = "{msg:24} {wide_bar} {human_pos}/{human_len} {per_sec} {eta} left";
    let bar = ProgressBar::new(total as u64).with_message(task);
    bar.set_style(ProgressStyle::with_template(style).expect("the template is well-formed"));
    bar
}

/// A progress bar over the bytes of files.
pub fn bytes(total: u64) -> ProgressBar {
    let style = "{msg:24} {wide_bar} {bytes}/{total_bytes} {bytes_per_sec} {eta} left";
    let bar = ProgressBar::new(total).with_message("importing");
    bar.set_style(ProgressStyle::with_template(style).expect("the template is well-formed"));
    bar
}

/// A sign of life for work of unknown length, on standard error.
pub fn spinner(task: &'static str) -> ProgressBar {
    let spinner = ProgressBar::new_spinner().with_message(task);
    spinner.enable_steady_tick(Duration::from_millis(100));
    spinner
}

/// A number with separators between thousands.
pub fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let groups: Vec<&str> = digits
        .as_bytes()
        .rchunks(3)
        .rev()
        .map(|group| std::str::from_utf8(group).unwrap_or_default())
        .collect();
    groups.join(",")
}

/// A share in percent, with enough digits to tell nearly all from all.
pub fn percent(part: usize, whole: usize) -> String {
    if whole == 0 {
        return "–".to_owned();
    }
    format!("{:.2} %", 100.0 * part as f64 / whole as f64)
}

/// Columns of text, aligned; `right` says which ones hold numbers.
pub fn table(heading: &[&str], right: &[bool], rows: &[Vec<String>]) -> String {
    let heading: Vec<String> = heading.iter().map(|&title| title.to_owned()).collect();
    let lines = || std::iter::once(&heading).chain(rows);
    let width = |column: usize| {
        lines()
            .map(|line| line[column].chars().count())
            .max()
            .unwrap_or_default()
    };
    let widths: Vec<usize> = (0..heading.len()).map(width).collect();
    let cell = |column: usize, text: &str| match right[column] {
        true => format!("{text:>0$}", widths[column]),
        false => format!("{text:<0$}", widths[column]),
    };
    let text = lines().map(|line| {
        let cells: Vec<String> = line
            .iter()
            .enumerate()
            .map(|(column, text)| cell(column, text))
            .collect();
        cells.join("  ").trim_end().to_owned()
    });
    text.collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_grouped_from_the_right() {
        assert_eq!(
            [0, 999, 1000, 1_234_567].map(grouped),
            ["0", "999", "1,000", "1,234,567"]
        );
    }

    #[test]
    fn a_share_of_nothing_is_no_number() {
        assert_eq!([percent(1, 3), percent(0, 0)], ["33.33 %", "–"]);
    }

    #[test]
    fn columns_line_up() {
        let rows = [
            vec!["7".into(), "a".into()],
            vec!["1234".into(), "bcd".into()],
        ];
        let text = table(&["id", "name"], &[true, false], &rows);
        assert_eq!(text, "  id  name\n   7  a\n1234  bcd");
    }
}
