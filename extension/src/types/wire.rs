//! Binary input and output: numbers in order, eight bytes each, most significant first, or bytes.

use super::Raw;
use crate::error::Refusal;
use pgrx::{PgSqlErrorCode, pg_sys};

/// Reads `N` numbers from a message.
pub fn receive<const N: usize>(
    message: &Raw<pg_sys::StringInfoData>,
    type_name: &str,
) -> Result<[f64; N], Refusal> {
    // SAFETY: a receive function is called with a StringInfo that it may advance.
    let buffer = unsafe { &mut *message.as_ptr() };
    let left = usize::try_from(buffer.len - buffer.cursor).unwrap_or(0);
    if left < N * 8 {
        return Err(Refusal::new(
            PgSqlErrorCode::ERRCODE_PROTOCOL_VIOLATION,
            format!("binary value of type {type_name} is too short: {left} bytes"),
        )
        .detail(format!("It has {N} numbers of 8 bytes each.")));
    }
    // SAFETY: `data` holds `len` bytes, of which at least N * 8 follow the cursor.
    let bytes = unsafe {
        let start = buffer.data.add(usize::try_from(buffer.cursor).unwrap_or(0));
        std::slice::from_raw_parts(start.cast::<u8>(), N * 8)
    };
    let numbers = std::array::from_fn(|i| {
        let mut eight = [0; 8];
        eight.copy_from_slice(&bytes[i * 8..i * 8 + 8]);
        f64::from_be_bytes(eight)
    });
    buffer.cursor += i32::try_from(N * 8).unwrap_or(0);
    Ok(numbers)
}

/// The bytes to send for some numbers.
pub fn send(numbers: &[f64]) -> Vec<u8> {
    numbers
        .iter()
        .flat_map(|number| number.to_be_bytes())
        .collect()
}

/// All that is left of a message.
pub fn rest(message: &Raw<pg_sys::StringInfoData>) -> &[u8] {
    // SAFETY: a receive function is called with a StringInfo that it may advance; `data` holds
    // `len` bytes, and the message outlives the call.
    unsafe {
        let buffer = &mut *message.as_ptr();
        let start = usize::try_from(buffer.cursor).unwrap_or(0);
        let bytes = std::slice::from_raw_parts(
            buffer.data.cast::<u8>().add(start),
            usize::try_from(buffer.len)
                .unwrap_or(0)
                .saturating_sub(start),
        );
        buffer.cursor = buffer.len;
        bytes
    }
}
