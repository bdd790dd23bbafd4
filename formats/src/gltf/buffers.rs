//! The bytes of a document: the second chunk of a GLB, inside the JSON, or in files beside it.

use std::borrow::Cow;

use base64::Engine;
use base64::alphabet;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use percent_encoding::percent_decode_str;
use serde::Deserialize;
use serde_json::value::RawValue;

use super::document::parse;
use crate::error::{Problem, quote, shorten};
use crate::input::ReadOptions;

/// Most bytes of a file and its buffers together: all of them are in memory at once.
pub(super) const MAX_INPUT_BYTES: usize = 384 << 20;

/// Writers forget to pad.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &alphabet::STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Buffer<'a> {
    #[serde(borrow)]
    uri: Option<Cow<'a, str>>,
    byte_length: u64,
}

/// Fetches all buffers of a file that is so long itself.
pub(super) fn load<'a>(
    buffers: &[&'a RawValue],
    binary: Option<&'a [u8]>,
    file_bytes: usize,
    options: &ReadOptions<'_>,
) -> Result<Vec<Cow<'a, [u8]>>, Problem> {
    let mut total = file_bytes;
    let mut loaded = Vec::new();
    for (i, raw) in buffers.iter().enumerate() {
        let what = format!("buffer {i}");
        let buffer: Buffer<'a> = parse(&what, raw)?;
        let bytes = match (&buffer.uri, binary) {
            (Some(uri), _) => Cow::Owned(fetch(&what, uri, options)?),
            (None, Some(binary)) if i == 0 => Cow::Borrowed(binary),
            (None, _) => {
                return Err(Problem::Missing {
                    what: format!("the uri of {what}"),
                });
            }
        };
        if matches!(bytes, Cow::Owned(_)) {
            total = total.saturating_add(bytes.len());
            check_total(total)?;
        }
        if (bytes.len() as u64) < buffer.byte_length {
            return Err(Problem::Invalid {
                what: format!("the byteLength of {what}"),
                found: buffer.byte_length.to_string(),
                expected: "no more than there are",
            });
        }
        loaded.push(bytes);
    }
    Ok(loaded)
}

/// Refuses more bytes of input than are read.
pub(super) fn check_total(bytes: usize) -> Result<(), Problem> {
    if bytes > MAX_INPUT_BYTES {
        return Err(Problem::Limit {
            what: "bytes of input",
            found: bytes as u64,
            limit: MAX_INPUT_BYTES as u64,
        });
    }
    Ok(())
}

fn fetch(what: &str, uri: &str, options: &ReadOptions<'_>) -> Result<Vec<u8>, Problem> {
    if let Some(data) = uri.strip_prefix("data:") {
        return decode(what, data);
    }
    if uri.contains("://") {
        return Err(Problem::Unsupported {
            what: format!("{what} at {}", quote(uri)),
        });
    }
    let name = percent_decode_str(uri).decode_utf8_lossy();
    (options.companion)(&name).map_err(|error| Problem::Unreadable {
        message: format!("{what}, {}: {error}", quote(&name)),
    })
}

/// The content of a data URI, without its `data:`.
fn decode(what: &str, data: &str) -> Result<Vec<u8>, Problem> {
    let (kind, content) = data.split_once(',').ok_or_else(|| Problem::Invalid {
        what: format!("the data uri of {what}"),
        found: quote(data),
        expected: "a comma before the content",
    })?;
    if !kind.ends_with(";base64") {
        return Ok(percent_decode_str(content).collect());
    }
    BASE64.decode(content).map_err(|error| Problem::Malformed {
        what: format!("the base64 of {what}"),
        message: shorten(&error.to_string().to_lowercase()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn input_is_limited() {
        assert_eq!(check_total(MAX_INPUT_BYTES), Ok(()));
        assert_eq!(
            check_total(MAX_INPUT_BYTES + 1).unwrap_err().to_string(),
            "402653185 bytes of input exceed the limit of 402653184"
        );
    }

    #[test]
    fn data_uris_are_base64_or_percent_encoded() {
        assert_eq!(decode("buffer 0", ";base64,AQID"), Ok(vec![1, 2, 3]));
        assert_eq!(
            decode("buffer 0", "application/octet-stream;base64,AQ"),
            Ok(vec![1])
        );
        assert_eq!(decode("buffer 0", ",a%00"), Ok(vec![b'a', 0]));
    }
}
