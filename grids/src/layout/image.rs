//! The images of ROS maps: PGM and its relatives, as map savers write them, and PNG.

use std::fmt;
use std::io::Cursor;

use png::{BitDepth, Decoder, Limits, Transformations};
use tautline_io::diagnostic::Diagnostic;

use super::{Layout, MAX_CELLS};

/// Red, green, blue, and how opaque it is.
pub(super) type Pixel = [u8; 4];

/// The image of a ROS map cannot be read or decoded.
pub(super) fn unread_image(message: impl fmt::Display) -> Diagnostic {
    Diagnostic::usage(format_args!("the image cannot be read: {message}"), "give a whole PGM or PNG file")
}

/// Decodes the `bytes` of an image: an open layout of its width and height, which are checked before any pixel is
/// decoded, and its pixels row by row.
///
/// # Errors
/// [`Diagnostic`] if it is none, or too large for a layout.
pub(super) fn decode(bytes: &[u8]) -> Result<(Layout, Vec<Pixel>), Diagnostic> {
    match bytes {
        [b'P', b'2' | b'3' | b'5' | b'6', ..] => decode_pnm(bytes),
        [0x89, b'P', b'N', b'G', ..] => decode_png(bytes),
        _ => Err(unread_image("it is neither PGM nor PNG")),
    }
}

fn decode_png(bytes: &[u8]) -> Result<(Layout, Vec<Pixel>), Diagnostic> {
    let undecoded = |error: png::DecodingError| unread_image(error);
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: 16 * MAX_CELLS as usize });
    decoder.set_transformations(Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(undecoded)?;
    let (width, height) = reader.info().size();
    let layout = Layout::open(width.into(), height.into())?;
    let size = reader.output_buffer_size().ok_or_else(|| unread_image("it is too large"))?;
    let mut samples = vec![0; size];
    let frame = reader.next_frame(&mut samples).map_err(undecoded)?;
    samples.truncate(frame.buffer_size());
    if frame.bit_depth == BitDepth::Sixteen {
        let wide = samples
            .chunks_exact(2)
            .filter_map(|pair| scaled(u16::from_be_bytes([pair[0], pair[1]]).into(), u16::MAX));
        samples = wide.collect();
    }
    Ok((layout, samples.chunks_exact(frame.color_type.samples()).map(pixel).collect()))
}

/// The pixel of grey, or red, green and blue, with or without how opaque it is.
fn pixel(samples: &[u8]) -> Pixel {
    match *samples {
        [grey] => [grey, grey, grey, u8::MAX],
        [grey, alpha] => [grey, grey, grey, alpha],
        [red, green, blue] => [red, green, blue, u8::MAX],
        [red, green, blue, alpha, ..] => [red, green, blue, alpha],
        [] => [0; 4],
    }
}

/// A sample from 0 to `most`, which is above 0, from 0 to 255; `None` if it is above `most`.
fn scaled(sample: u32, most: u16) -> Option<u8> {
    let most = u32::from(most);
    (sample <= most).then(|| ((sample * 255 + most / 2) / most) as u8)
}

/// Decodes the formats P2, P3, P5 and P6: grey or coloured, in decimal numbers or bytes.
fn decode_pnm(bytes: &[u8]) -> Result<(Layout, Vec<Pixel>), Diagnostic> {
    let wrong = |what: &str| unread_image(what);
    let mut numbers = Numbers(&bytes[2..]);
    let mut positive = |what: &str| numbers.next().filter(|&number| number > 0).ok_or_else(|| wrong(what));
    let (width, height) = (
        positive("its width is no number from 1 to 4294967295")?,
        positive("its height is no number from 1 to 4294967295")?,
    );
    let most = positive("its largest level is no number from 1 to 65535")?;
    let most = u16::try_from(most).map_err(|_| wrong("its largest level is no number from 1 to 65535"))?;
    let layout = Layout::open(width.into(), height.into())?;
    let is_plain = matches!(bytes[1], b'2' | b'3');
    let channels = if matches!(bytes[1], b'2' | b'5') { 1 } else { 3 };
    let count = width as usize * height as usize * channels;
    let samples: Option<Vec<u8>> = if is_plain {
        numbers.take(count).map(|sample| scaled(sample, most)).collect()
    } else {
        if numbers.0.starts_with(b"\r\n") {
            return Err(wrong("its header ends in CR LF, and the LF would be its first pixel"));
        }
        // One blank stands between the largest level and the first sample.
        let raster = numbers.0.get(1..).unwrap_or_default();
        if most > u16::from(u8::MAX) {
            let pairs = raster.chunks_exact(2).map(|pair| u16::from_be_bytes([pair[0], pair[1]]));
            pairs.take(count).map(|sample| scaled(sample.into(), most)).collect()
        } else {
            raster.iter().take(count).map(|&sample| scaled(sample.into(), most)).collect()
        }
    };
    let samples = samples.ok_or_else(|| wrong("a pixel is above its largest level"))?;
    if samples.len() < count {
        return Err(wrong(if is_plain {
            "before its last pixel it ends, or has something that is no number"
        } else {
            "it ends before its last pixel"
        }));
    }
    Ok((layout, samples.chunks_exact(channels).map(pixel).collect()))
}

/// The decimal numbers of a text, with blanks and comments between them. It ends where something else stands.
struct Numbers<'a>(&'a [u8]);

impl Iterator for Numbers<'_> {
    type Item = u32;

    fn next(&mut self) -> Option<u32> {
        loop {
            self.0 = self.0.trim_ascii_start();
            if self.0.first() != Some(&b'#') {
                break;
            }
            let end = self.0.iter().position(|&byte| byte == b'\n').unwrap_or(self.0.len());
            self.0 = &self.0[end..];
        }
        let end = self.0.iter().position(|byte| !byte.is_ascii_digit()).unwrap_or(self.0.len());
        let (digits, rest) = self.0.split_at(end);
        self.0 = rest;
        str::from_utf8(digits).ok()?.parse().ok()
    }
}
