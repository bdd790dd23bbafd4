//! GLB, the container of a glTF document and its bytes.

use crate::error::Problem;

/// First bytes of every GLB.
pub(super) const MAGIC: &[u8] = b"glTF";

const VERSION: u32 = 2;
const JSON: &[u8; 4] = b"JSON";
const BINARY: &[u8; 4] = b"BIN\0";

/// Bytes of the header of a file.
const FILE_HEADER: usize = 12;

/// Bytes of the header of a chunk.
const CHUNK_HEADER: usize = 8;

/// A document and its bytes in one file; the size that is too large where it is.
pub(super) fn pack(mut json: Vec<u8>, mut binary: Vec<u8>) -> Result<Vec<u8>, usize> {
    json.resize(json.len().next_multiple_of(4), b' ');
    binary.resize(binary.len().next_multiple_of(4), 0);
    let chunks = [(JSON, json), (BINARY, binary)];
    let chunks = chunks.iter().filter(|(_, content)| !content.is_empty());
    let size = |(_, content): &(_, Vec<u8>)| CHUNK_HEADER + content.len();
    let length = FILE_HEADER + chunks.clone().map(size).sum::<usize>();
    let word = |count: usize| {
        u32::try_from(count)
            .map(u32::to_le_bytes)
            .map_err(|_| count)
    };
    let mut file = Vec::with_capacity(length);
    file.extend_from_slice(MAGIC);
    file.extend_from_slice(&VERSION.to_le_bytes());
    file.extend_from_slice(&word(length)?);
    for (kind, content) in chunks {
        file.extend_from_slice(&word(content.len())?);
        file.extend_from_slice(*kind);
        file.extend_from_slice(content);
    }
    Ok(file)
}

/// The document of a GLB, and its bytes where it has some.
pub(super) fn unpack(file: &[u8]) -> Result<(&[u8], Option<&[u8]>), Problem> {
    let rest = file.strip_prefix(MAGIC).unwrap_or(file);
    let (version, rest) = word("the version", rest)?;
    if version != VERSION {
        return Err(Problem::Invalid {
            what: "glb version".to_owned(),
            found: version.to_string(),
            expected: "2",
        });
    }
    let (length, _) = word("the length", rest)?;
    let file = file.get(..length as usize).ok_or_else(|| cut("the file"))?;
    let chunks = file.get(FILE_HEADER..).unwrap_or_default();
    let (json, rest) = chunk(chunks)?;
    if json.kind != JSON {
        return Err(Problem::Missing {
            what: "the json chunk".to_owned(),
        });
    }
    if rest.is_empty() {
        return Ok((json.content, None));
    }
    let (binary, _) = chunk(rest)?;
    Ok((
        json.content,
        (binary.kind == BINARY).then_some(binary.content),
    ))
}

struct Chunk<'a> {
    kind: &'a [u8],
    content: &'a [u8],
}

/// The first chunk, and what follows it.
fn chunk(bytes: &[u8]) -> Result<(Chunk<'_>, &[u8]), Problem> {
    let (length, rest) = word("a chunk", bytes)?;
    let (kind, rest) = rest.split_at_checked(4).ok_or_else(|| cut("a chunk"))?;
    let (content, rest) = rest
        .split_at_checked(length as usize)
        .ok_or_else(|| cut("a chunk"))?;
    Ok((Chunk { kind, content }, rest))
}

fn word<'a>(what: &str, bytes: &'a [u8]) -> Result<(u32, &'a [u8]), Problem> {
    let (word, rest) = bytes.split_first_chunk().ok_or_else(|| cut(what))?;
    Ok((u32::from_le_bytes(*word), rest))
}

fn cut(what: &str) -> Problem {
    Problem::Malformed {
        what: what.to_owned(),
        message: "it ends too early".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chunks_are_padded_and_found_again() {
        let file = pack(b"{}".to_vec(), vec![1, 2, 3, 4, 5]).unwrap();
        assert_eq!(file.len(), 12 + 8 + 4 + 8 + 8);
        let (json, binary) = unpack(&file).unwrap();
        assert_eq!(json, b"{}  ");
        assert_eq!(binary, Some(&[1, 2, 3, 4, 5, 0, 0, 0][..]));
        let file = pack(b"{   }".to_vec(), Vec::new()).unwrap();
        assert_eq!(unpack(&file).unwrap(), (&b"{   }   "[..], None));
    }

    #[test]
    fn every_cut_is_refused() {
        let file = pack(b"{}".to_vec(), vec![1]).unwrap();
        for length in 4..file.len() {
            let message = unpack(&file[..length]).unwrap_err().to_string();
            assert!(
                message.ends_with("is malformed: it ends too early"),
                "{message}"
            );
        }
    }

    #[test]
    fn other_versions_are_refused() {
        let message = unpack(b"glTF\x01\0\0\0").unwrap_err().to_string();
        assert_eq!(message, "glb version is 1, expected 2");
    }
}
