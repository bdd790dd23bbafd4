//! From the statements of a file to its features.

use std::collections::HashMap;
use std::io::{BufRead, SeekFrom};
use std::ops::ControlFlow;
use std::path::Path;

use super::features::Features;
use super::lines::Lines;
use super::materials::{Library, add_library, check_name};
use crate::error::{FormatError, Location, Problem, quote};
use crate::input::{Input, ReadOptions, Sink};
use crate::limits::{Budget, Limits};

/// Most that is read: all vertices are held until the end, and a name for each section.
const LIMITS: Limits = Limits {
    objects: 1_000_000,
    vertices: 16_000_000,
    ..Limits::STANDARD
};

/// What begins a feature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Division {
    Objects,
    Groups,
}

/// Reads a file, twice: which names begin how many sections has to be known first.
///
/// # Errors
/// Vertices that are no numbers, faces with indices of no vertex, and more than the reader's
/// limits; the error names the line.
pub(crate) fn read(
    name: &str,
    input: &mut dyn Input,
    options: &ReadOptions<'_>,
    sink: &mut Sink<'_>,
) -> Result<(), FormatError> {
    let file = Location::file(name);
    let at_file = |problem: Problem| file.error(problem);
    let mut budget = Budget::new(&LIMITS, 0).map_err(at_file)?;
    let stem = Path::new(name)
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy();
    let start = input
        .stream_position()
        .map_err(|error| at_file(error.into()))?;
    let mut lines = Lines::new(&mut *input);
    let division = sections(&mut lines, &stem, &mut budget);
    let (division, sections) =
        division.map_err(|problem| file.line(Some(lines.number)).error(problem))?;
    let again = input.seek(SeekFrom::Start(start));
    again.map_err(|error| at_file(error.into()))?;
    let mut lines = Lines::new(input);
    let mut reader = Reader {
        options,
        budget,
        division,
        features: Features::new(sections, options.batch_bytes, sink),
        library: Library::new(),
        library_is_missing: false,
        vertices: Vec::new(),
        name: stem.to_string(),
        stem: stem.to_string(),
        material: None,
    };
    let mut statements = || -> Result<ControlFlow<()>, Problem> {
        while let Some((keyword, rest)) = lines.next()? {
            if reader.statement(&keyword, &rest)?.is_break() {
                return Ok(ControlFlow::Break(()));
            }
        }
        Ok(ControlFlow::Continue(()))
    };
    let end = statements();
    if end
        .map_err(|problem| file.line(Some(lines.number)).error(problem))?
        .is_continue()
    {
        let _ = reader.features.end_section(&reader.name);
        reader.features.finish();
    }
    Ok(())
}

/// What divides the file, and how many sections each name has. The stem names what comes before
/// the first one.
fn sections<R: BufRead>(
    lines: &mut Lines<R>,
    stem: &str,
    budget: &mut Budget,
) -> Result<(Division, HashMap<String, usize>), Problem> {
    let first = || HashMap::from([(stem.to_owned(), 1)]);
    let (mut objects, mut groups) = (first(), first());
    let mut division = Division::Groups;
    while let Some((keyword, rest)) = lines.next()? {
        let sections = match keyword.as_str() {
            "o" => {
                division = Division::Objects;
                &mut objects
            }
            "g" => &mut groups,
            _ => continue,
        };
        budget.objects(1)?;
        check_name(&rest)?;
        *sections.entry(named(rest, stem)).or_default() += 1;
    }
    match division {
        Division::Objects => Ok((division, objects)),
        Division::Groups => Ok((division, groups)),
    }
}

/// The name of a section.
fn named(rest: String, stem: &str) -> String {
    if rest.is_empty() {
        stem.to_owned()
    } else {
        rest
    }
}

struct Reader<'o, 's, 'f> {
    options: &'o ReadOptions<'o>,
    budget: Budget,
    division: Division,
    features: Features<'s, 'f>,
    library: Library,
    library_is_missing: bool,
    vertices: Vec<[f64; 3]>,
    /// Names sections that have no name.
    stem: String,
    /// Name of the section that statements are in.
    name: String,
    material: Option<String>,
}

impl Reader<'_, '_, '_> {
    /// Takes a statement; what changes no shape is passed over. Breaks where the sink has enough.
    fn statement(&mut self, keyword: &str, rest: &str) -> Result<ControlFlow<()>, Problem> {
        match keyword {
            "v" => self.vertex(rest)?,
            "f" | "fo" => self.face(rest)?,
            "o" if self.division == Division::Objects => return Ok(self.section(rest)),
            "g" if self.division == Division::Groups => return Ok(self.section(rest)),
            "usemtl" => {
                check_name(rest)?;
                self.material = (!rest.is_empty()).then(|| rest.to_owned());
            }
            "mtllib" => self.libraries(rest)?,
            "l" | "p" => self.features.note(&self.name, "lines and points left out"),
            "curv" | "curv2" | "surf" => {
                self.features
                    .note(&self.name, "free-form surfaces left out");
            }
            _ => {}
        }
        Ok(ControlFlow::Continue(()))
    }

    fn section(&mut self, rest: &str) -> ControlFlow<()> {
        let next = named(rest.to_owned(), &self.stem);
        let before = std::mem::replace(&mut self.name, next);
        self.features.end_section(&before)
    }

    fn vertex(&mut self, rest: &str) -> Result<(), Problem> {
        self.budget.vertices(1)?;
        let mut position = [0.0; 3];
        let mut texts = rest.split_whitespace();
        for coordinate in &mut position {
            let text = texts.next().unwrap_or_default();
            let number = text.parse().ok().filter(|number: &f64| number.is_finite());
            *coordinate = number.ok_or_else(|| Problem::Invalid {
                what: "a coordinate".to_owned(),
                found: quote(text),
                expected: "a number",
            })?;
        }
        // Adding zero makes a negative zero positive, so that equal positions are equal in bits.
        self.vertices.push(position.map(|c| c + 0.0));
        Ok(())
    }

    fn face(&mut self, rest: &str) -> Result<(), Problem> {
        let corners = rest.split_whitespace();
        let ring: Result<Vec<_>, Problem> = corners.map(|corner| self.corner(corner)).collect();
        let ring = ring?;
        let material = self.material.as_deref().map(|name| (name, &self.library));
        if material.is_some() && self.library_is_missing {
            self.features
                .note(&self.name, "a material library is missing");
        }
        self.features
            .add_face(&self.name, ring, material, &mut self.budget)
    }

    /// The position of a corner: the first of its indices, from 1 on, or back from the last vertex.
    fn corner(&self, text: &str) -> Result<[f64; 3], Problem> {
        let digits = text.split('/').next().unwrap_or_default();
        let index = digits.parse::<i64>().ok().filter(|index| *index != 0);
        let index = index.ok_or_else(|| Problem::Invalid {
            what: "a corner of a face".to_owned(),
            found: quote(text),
            expected: "the number of a vertex, from 1 on or negative",
        })?;
        let count = self.vertices.len();
        let place = match usize::try_from(index) {
            Ok(index) => Some(index - 1),
            Err(_) => usize::try_from(index.unsigned_abs())
                .ok()
                .and_then(|back| count.checked_sub(back)),
        };
        let position = place.and_then(|place| self.vertices.get(place));
        position.copied().ok_or_else(|| Problem::Invalid {
            what: "a corner of a face".to_owned(),
            found: quote(digits),
            expected: "the number of a vertex before it",
        })
    }

    /// Reads the libraries that a statement names: one whose name may have blanks, or several.
    fn libraries(&mut self, rest: &str) -> Result<(), Problem> {
        if let Ok(text) = (self.options.companion)(rest) {
            return add_library(&mut self.library, &text, &mut self.budget);
        }
        for name in rest.split_whitespace() {
            match (self.options.companion)(name) {
                Ok(text) => add_library(&mut self.library, &text, &mut self.budget)?,
                Err(_) => self.library_is_missing = true,
            }
        }
        Ok(())
    }
}
