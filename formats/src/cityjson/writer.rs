//! JSON written piece by piece, since most pieces are raw text already.

/// An object under way; members are written in turn, and `end` closes it.
#[derive(Debug)]
pub(super) struct ObjectWriter<'o> {
    out: &'o mut String,
    is_empty: bool,
}

impl<'o> ObjectWriter<'o> {
    /// Opens an object.
    pub(super) fn start(out: &'o mut String) -> Self {
        out.push('{');
        Self {
            out,
            is_empty: true,
        }
    }

    /// Begins a member; its value is to be appended to what this gives.
    pub(super) fn member(&mut self, name: &str) -> &mut String {
        if !std::mem::replace(&mut self.is_empty, false) {
            self.out.push(',');
        }
        write_string(self.out, name);
        self.out.push(':');
        self.out
    }

    /// Closes the object.
    pub(super) fn end(self) {
        self.out.push('}');
    }
}

/// Writes an array, each element by the given function.
pub(super) fn write_array<T>(
    out: &mut String,
    elements: &[T],
    mut write: impl FnMut(&T, &mut String),
) {
    out.push('[');
    for (i, element) in elements.iter().enumerate() {
        if i > 0 {
            out.push(',');
        }
        write(element, out);
    }
    out.push(']');
}

/// Writes a string with its quotes and escapes.
pub(super) fn write_string(out: &mut String, text: &str) {
    out.push_str(&serde_json::Value::from(text).to_string());
}

/// Writes a stored vertex: integers as such, other numbers in the shortest form that reads back.
pub(super) fn write_vertex(out: &mut String, vertex: [f64; 3]) {
    /// Whole numbers below this are exact in an f64.
    const EXACT: f64 = 9_007_199_254_740_992.0;
    write_array(out, &vertex, |coordinate, out| {
        let is_integer = coordinate.fract() == 0.0 && coordinate.abs() < EXACT;
        out.push_str(&match is_integer {
            true => (*coordinate as i64).to_string(),
            false => format!("{coordinate:?}"),
        });
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn objects_have_commas_between_and_escapes_within() {
        let mut out = String::new();
        let mut object = ObjectWriter::start(&mut out);
        object.member("a\"b").push('1');
        write_vertex(object.member("v"), [-3.0, 0.25, 1e300]);
        object.end();
        assert_eq!(out, r#"{"a\"b":1,"v":[-3,0.25,1e300]}"#);
    }
}
