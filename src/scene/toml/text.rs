//! Decodes the text of a scene file, in the encodings that editors and shells write.

/// The text, or the line and the reason if the bytes are not text.
pub(in crate::scene) fn decode(bytes: Vec<u8>) -> Result<String, (usize, String)> {
    if let Some(rest) = bytes.strip_prefix(b"\xef\xbb\xbf") {
        return utf8(rest.to_vec());
    }
    // UTF-32 is checked first, because its little-endian byte order mark begins with that of UTF-16.
    if bytes.starts_with(&[0xff, 0xfe, 0, 0]) || bytes.starts_with(&[0, 0, 0xfe, 0xff]) {
        return Err((1, "the file is UTF-32; save it as UTF-8".into()));
    }
    match bytes.as_slice() {
        [0xff, 0xfe, rest @ ..] => utf16(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => utf16(rest, u16::from_be_bytes),
        // UTF-16 without a byte order mark: a scene file begins with an ASCII letter, so one of its two bytes is 0.
        [1..=127, 0, ..] => utf16(&bytes, u16::from_le_bytes),
        [0, 1..=127, ..] => utf16(&bytes, u16::from_be_bytes),
        _ => utf8(bytes),
    }
}

fn utf8(bytes: Vec<u8>) -> Result<String, (usize, String)> {
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let byte = error.as_bytes()[at];
        // The file is most likely in Latin-1, so the message shows the letter in Latin-1.
        let letter = char::from(byte);
        let meant = if letter.is_control() { String::new() } else { format!(", {letter} in Latin-1") };
        let message = format!(
            "the file is not UTF-8: here is a byte that no letter of UTF-8 has, {byte:#04x}{meant}; save the file \
             as UTF-8"
        );
        (line(&error.as_bytes()[..at]), message)
    })
}

fn utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Result<String, (usize, String)> {
    let (pairs, rest) = bytes.as_chunks();
    let mut text = String::with_capacity(pairs.len());
    for letter in char::decode_utf16(pairs.iter().map(|pair| unit(*pair))) {
        match letter {
            Ok(letter) => text.push(letter),
            Err(_) => return Err((line(text.as_bytes()), DAMAGED_UTF16.into())),
        }
    }
    if rest.is_empty() { Ok(text) } else { Err((line(text.as_bytes()), DAMAGED_UTF16.into())) }
}

const DAMAGED_UTF16: &str = "the file seems to be UTF-16, and is damaged here; save it as UTF-8";

/// The number of the line in which this text ends, from 1.
fn line(before: &[u8]) -> usize {
    before.iter().filter(|byte| **byte == b'\n').count() + 1
}
