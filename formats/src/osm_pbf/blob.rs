//! The blobs of a file, unpacked one by one.

use std::io::{Read, SeekFrom};

use flate2::bufread::ZlibDecoder;

use super::wire::{Broken, Fields, Value};
use crate::error::{Problem, quote};
use crate::input::Input;

/// Longest header of a blob, bytes, by the format.
const MAX_HEADER_BYTES: u64 = 64 << 10;

/// Longest blob, packed or unpacked, bytes, by the format.
const MAX_BLOB_BYTES: u64 = 32 << 20;

/// Most bytes that a file holds unpacked: no more than a real file of the largest size unpacks to.
const MAX_UNPACKED_BYTES: u64 = 8 << 30;

/// Features of the format that a reader has to know.
const KNOWN_FEATURES: [&[u8]; 2] = [b"OsmSchema-V0.6", b"DenseNodes"];

/// Reads a file from its start, blob by blob.
pub(super) struct Blobs<'a> {
    input: &'a mut dyn Input,
    /// Where the next blob begins.
    offset: u64,
    max_input_bytes: u64,
    unpacked_bytes: u64,
    packed: Vec<u8>,
    block: Vec<u8>,
}

impl<'a> Blobs<'a> {
    /// Goes to the start and reads the header of the file.
    pub(super) fn open(input: &'a mut dyn Input, max_input_bytes: u64) -> Result<Self, Problem> {
        input.seek(SeekFrom::Start(0))?;
        let mut blobs = Self {
            input,
            offset: 0,
            max_input_bytes,
            unpacked_bytes: 0,
            packed: Vec::new(),
            block: Vec::new(),
        };
        if blobs.next_of("OSMHeader")?.is_none() {
            return Err(Problem::Missing {
                what: "the header block".into(),
            });
        }
        check_features(&blobs.block)?;
        Ok(blobs)
    }

    /// The next block of data and where its blob begins; none at the end of the file.
    pub(super) fn next(&mut self) -> Result<Option<(u64, &[u8])>, Problem> {
        let offset = self.next_of("OSMData")?;
        Ok(offset.map(|offset| (offset, self.block.as_slice())))
    }

    /// Unpacks the next blob of a kind; others are passed over.
    fn next_of(&mut self, kind: &str) -> Result<Option<u64>, Problem> {
        loop {
            let start = self.offset;
            let broken = |broken: Broken| broken.at("the blob", start);
            let Some(header_bytes) = self.header_length()? else {
                return Ok(None);
            };
            if header_bytes > MAX_HEADER_BYTES {
                return Err(limit(
                    "bytes of a blob's header",
                    header_bytes,
                    MAX_HEADER_BYTES,
                ));
            }
            self.read(header_bytes)?;
            let (found, data_bytes) = header(&self.packed).map_err(broken)?;
            let found = found == kind.as_bytes();
            if data_bytes > MAX_BLOB_BYTES {
                return Err(limit("bytes of a blob", data_bytes, MAX_BLOB_BYTES));
            }
            self.read(data_bytes)?;
            if found {
                self.unpack(start)?;
                return Ok(Some(start));
            }
        }
    }

    /// The length of the next blob's header; none at the end of the file.
    fn header_length(&mut self) -> Result<Option<u64>, Problem> {
        if self.input.fill_buf()?.is_empty() {
            return Ok(None);
        }
        self.read(4)?;
        let length = self
            .packed
            .iter()
            .fold(0, |sum, byte| sum << 8 | u64::from(*byte));
        Ok(Some(length))
    }

    /// Reads so many bytes, which have to be there. No more memory is taken than there are bytes.
    fn read(&mut self, count: u64) -> Result<(), Problem> {
        self.offset += count;
        if self.offset > self.max_input_bytes {
            return Err(limit("bytes of input", self.offset, self.max_input_bytes));
        }
        self.packed.clear();
        let found = (&mut self.input)
            .take(count)
            .read_to_end(&mut self.packed)?;
        if found as u64 != count {
            let start = self.offset - count;
            return Err(Broken("the file ends within it").at("the blob", start));
        }
        Ok(())
    }

    /// Unpacks the blob that was read.
    fn unpack(&mut self, offset: u64) -> Result<(), Problem> {
        let broken = |broken: Broken| broken.at("the blob", offset);
        self.block.clear();
        for field in Fields(&self.packed) {
            match field.map_err(broken)? {
                (1, raw) => self.block.extend(raw.bytes().map_err(broken)?),
                (3, zlib) => {
                    let zlib = zlib.bytes().map_err(broken)?;
                    let most = MAX_BLOB_BYTES + 1 - (self.block.len() as u64).min(MAX_BLOB_BYTES);
                    let mut inflated = ZlibDecoder::new(zlib).take(most);
                    let result = inflated.read_to_end(&mut self.block);
                    result.map_err(|_| broken(Broken("its zlib data is corrupt")))?;
                }
                (number @ 4..=7, _) => return Err(unsupported_packing(number)),
                _ => (),
            }
            if self.block.len() as u64 > MAX_BLOB_BYTES {
                let found = self.block.len() as u64;
                return Err(limit("bytes of an unpacked blob", found, MAX_BLOB_BYTES));
            }
        }
        self.unpacked_bytes += self.block.len() as u64;
        match self.unpacked_bytes > MAX_UNPACKED_BYTES {
            true => Err(limit(
                "unpacked bytes",
                self.unpacked_bytes,
                MAX_UNPACKED_BYTES,
            )),
            false => Ok(()),
        }
    }
}

/// The kind of a blob and the length of what follows.
fn header(bytes: &[u8]) -> Result<(&[u8], u64), Broken> {
    let (mut kind, mut length) = (None, None);
    for field in Fields(bytes) {
        match field? {
            (1, value) => kind = Some(value.bytes()?),
            (3, value) => length = Some(value.number()?),
            _ => (),
        }
    }
    kind.zip(length)
        .ok_or(Broken("its header lacks type or length"))
}

/// Refuses a file that needs what this reader does not know.
fn check_features(header: &[u8]) -> Result<(), Problem> {
    for field in Fields(header) {
        let (number, value) = field.map_err(|broken| broken.at("the header block", 0))?;
        if let (4, Value::Bytes(feature)) = (number, value)
            && !KNOWN_FEATURES.contains(&feature)
        {
            let feature = quote(&String::from_utf8_lossy(feature));
            return Err(Problem::Unsupported {
                what: format!("the required feature {feature}"),
            });
        }
    }
    Ok(())
}

fn unsupported_packing(number: u32) -> Problem {
    let packing = match number {
        4 => "lzma",
        5 => "bzip2",
        6 => "lz4",
        _ => "zstd",
    };
    Problem::Unsupported {
        what: format!("{packing} compression"),
    }
}

fn limit(what: &'static str, found: u64, limit: u64) -> Problem {
    Problem::Limit { what, found, limit }
}
