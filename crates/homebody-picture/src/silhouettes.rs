//! Silhouettes of cameras: one as a PNG, many as an animated PNG, moments side by side as a film strip.
//!
//! A body is white on dark ground. A camera without a picture slept, or saw no body: a film has it darker, a strip says so.

use homebody_core::camera::silhouette::Silhouette;
use homebody_core::geometry::Point;
use std::fmt::Write;

use super::font;
use super::paint::{HAIRLINE, INK, MUTED, Paint, WHITE};
use super::sheet::WIDTH;
use super::svg::{Anchor, Svg, Type};
use super::{MOST_PIXELS, PngError};

/// Red, green and blue of the parts of a film: between pictures, no picture, the ground of one, a body.
const PALETTE: [[u8; 3]; 4] = [[0x56, 0x5d, 0x66], [0x0c, 0x10, 0x15], [0x2b, 0x33, 0x3d], [0xff, 0xff, 0xff]];
const BETWEEN: u8 = 0;
const NONE: u8 = 1;
const GROUND: u8 = 2;
const BODY: u8 = 3;

/// Between two pictures of a film, in pixels of the cameras.
const GAP_PX: u32 = 3;

/// Draws a silhouette as a PNG of black and white in which each pixel is `scale` wide and high.
pub fn silhouette_png(picture: &Silhouette, scale: u32) -> Result<Vec<u8>, PngError> {
    let (columns, rows) = (picture.columns() as u32, picture.rows() as u32);
    let [width, height] = sized([columns, rows], scale)?;
    let mut row = vec![0u8; width.div_ceil(8) as usize];
    let mut data = Vec::with_capacity(row.len() * height as usize);
    for line in 0..rows as usize {
        row.fill(0);
        for column in (0..columns).filter(|&column| picture.is_set(column as usize, line)) {
            for at in column * scale..(column + 1) * scale {
                row[at as usize / 8] |= 128 >> (at % 8);
            }
        }
        (0..scale).for_each(|_| data.extend_from_slice(&row));
    }
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::One);
    let mut writer = encoder.write_header().map_err(unencoded)?;
    writer.write_image_data(&data).map_err(unencoded)?;
    writer.finish().map_err(unencoded)?;
    Ok(bytes)
}

#[derive(Clone, Debug, PartialEq)]
pub struct FilmFrame {
    /// By camera; `None` without a picture of this instant.
    pub silhouettes: Vec<Option<Silhouette>>,
    /// The time for which it is shown, in milliseconds.
    pub lasts_ms: u16,
}

/// Draws a film as an animated PNG that repeats for ever: pictures of cameras of these sizes, in columns and rows, side by side; each of
/// their pixels is `scale` wide and high.
pub fn silhouette_film(sizes: &[[u32; 2]], frames: &[FilmFrame], scale: u32) -> Result<Vec<u8>, PngError> {
    let gaps = GAP_PX * (sizes.len() as u32).saturating_sub(1);
    let columns = sizes.iter().map(|[columns, _]| columns).sum::<u32>() + gaps;
    let rows = sizes.iter().map(|[_, rows]| *rows).max().unwrap_or(0);
    let [width, height] = sized([columns, rows], scale)?;
    let count = u32::try_from(frames.len()).ok().filter(|&count| count > 0);
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Two);
    encoder.set_palette(PALETTE.concat());
    encoder.set_animated(count.ok_or(PngError::Size { width, height: 0 })?, 0).map_err(unencoded)?;
    let mut writer = encoder.write_header().map_err(unencoded)?;
    for frame in frames {
        writer.set_frame_delay(frame.lasts_ms, 1000).map_err(unencoded)?;
        writer.write_image_data(&drawn(sizes, frame, [columns, rows], scale)).map_err(unencoded)?;
    }
    writer.finish().map_err(unencoded)?;
    Ok(bytes)
}

/// The bytes of a frame: four pixels in each, row by row.
fn drawn(sizes: &[[u32; 2]], frame: &FilmFrame, [columns, rows]: [u32; 2], scale: u32) -> Vec<u8> {
    let mut line = vec![BETWEEN; (columns * scale) as usize];
    let mut data = Vec::new();
    for row in 0..rows {
        line.fill(BETWEEN);
        let mut left = 0;
        for ([wide, high], silhouette) in sizes.iter().zip(&frame.silhouettes) {
            for column in (0..*wide).filter(|_| row < *high) {
                let colour = match silhouette {
                    None => NONE,
                    Some(picture) if picture.is_set(column as usize, row as usize) => BODY,
                    Some(_) => GROUND,
                };
                let at = ((left + column) * scale) as usize;
                line[at..at + scale as usize].fill(colour);
            }
            left += wide + GAP_PX;
        }
        let packed: Vec<u8> = line
            .chunks(4)
            .map(|four| four.iter().enumerate().fold(0, |byte, (index, colour)| byte | colour << (6 - 2 * index)))
            .collect();
        (0..scale).for_each(|_| data.extend_from_slice(&packed));
    }
    data
}

/// So many columns and rows, enlarged.
fn sized([columns, rows]: [u32; 2], scale: u32) -> Result<[u32; 2], PngError> {
    let [width, height] = [columns, rows].map(|side| side.saturating_mul(scale));
    match width == 0 || height == 0 || width.max(height) > MOST_PIXELS {
        true => Err(PngError::Size { width, height }),
        false => Ok([width, height]),
    }
}

fn unencoded(error: png::EncodingError) -> PngError {
    PngError::Encoding(error.to_string())
}

#[derive(Clone, Debug, PartialEq)]
pub struct SilhouetteStrip {
    pub name: String,
    /// Each with its columns and rows.
    pub cameras: Vec<(String, [u32; 2])>,
    /// The moments, in order of time.
    pub moments: Vec<StripMoment>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct StripMoment {
    pub at: String,
    /// By camera; `None` without a picture of this moment.
    pub silhouettes: Vec<Option<Silhouette>>,
}

const MARGIN: f64 = 40.0;
/// Above the first moment: title and subtitle.
const TOP: f64 = 104.0;
/// Moments side by side, at most.
const COLUMNS: usize = 8;
const GAP: f64 = 8.0;
/// Above the pictures of moments: their times.
const CLOCK: f64 = 22.0;
/// Above the pictures of a camera: its name.
const NAME: f64 = 18.0;
const NIGHT: &str = "#2b333d";

/// Draws moments side by side, a row of pictures for each camera, as SVG.
pub fn silhouette_strip(strip: &SilhouetteStrip) -> String {
    let count = strip.moments.len();
    let columns = count.clamp(1, COLUMNS);
    let wide = (WIDTH - 2.0 * MARGIN - GAP * (columns as f64 - 1.0)) / columns as f64;
    let high = |[columns, rows]: [u32; 2]| wide * f64::from(rows) / f64::from(columns.max(1));
    let band: f64 = CLOCK + strip.cameras.iter().map(|(_, size)| NAME + high(*size) + GAP).sum::<f64>() + 18.0;
    let moments = if count == 1 { "1 moment".into() } else { format!("{count} moments") };
    let cameras = if strip.cameras.len() == 1 { "1 camera".into() } else { format!("{} cameras", strip.cameras.len()) };
    let from = strip.moments.first().map_or(String::new(), |first| format!(" from {} on", first.at));
    let subtitle = format!("{moments}{from} before {cameras}; silhouettes are all that they keep");
    let mut svg = Svg::new(&format!("{}: {subtitle}", strip.name), &told(strip));
    let title = font::shortened(&strip.name, 26.0, WIDTH - 2.0 * MARGIN);
    svg.text(&title, Point::new(MARGIN, 40.0), &Type::new(26.0, INK));
    svg.text(&subtitle, Point::new(MARGIN, 70.0), &Type::new(15.0, MUTED));
    for (line, moments) in strip.moments.chunks(columns).enumerate() {
        let top = TOP + line as f64 * band;
        for (index, moment) in moments.iter().enumerate() {
            let left = MARGIN + index as f64 * (wide + GAP);
            let clock = font::shortened(time_of(&moment.at), 12.5, wide);
            svg.text(&clock, Point::new(left, top), &Type::new(12.5, INK).strong());
            let mut y = top + CLOCK;
            for ((name, size), silhouette) in strip.cameras.iter().zip(&moment.silhouettes) {
                if index == 0 {
                    let name = font::shortened(name, 12.0, WIDTH - 2.0 * MARGIN);
                    svg.text(&name, Point::new(left, y), &Type::new(12.0, MUTED));
                }
                let (corner, extent) = (Point::new(left, y + NAME - 6.0), Point::new(wide, high(*size)));
                match silhouette {
                    Some(picture) => cell(&mut svg, picture, corner, extent),
                    None => empty(&mut svg, corner, extent),
                }
                y += NAME + extent.y + GAP;
            }
        }
    }
    svg.finish(WIDTH, TOP + band * count.div_ceil(columns) as f64)
}

fn cell(svg: &mut Svg, picture: &Silhouette, corner: Point, extent: Point) {
    svg.rectangle(corner, extent, &Paint::fill(NIGHT));
    let pixel = extent.x / picture.columns() as f64;
    svg.crisp(|svg| svg.path(&runs(picture, corner, pixel), &Paint::fill(WHITE)));
}

/// The pixels of a silhouette as a path: a rectangle for each run of them in a row.
fn runs(picture: &Silhouette, corner: Point, pixel: f64) -> String {
    let mut path = String::new();
    let mut run: Option<(usize, usize, usize)> = None;
    let mut close = |run: Option<(usize, usize, usize)>| {
        if let Some((from, to, row)) = run {
            // Edges instead of lengths: those of two rows that touch are then the same number.
            let [left, right] = [from, to].map(|column| corner.x + column as f64 * pixel);
            let [top, bottom] = [row, row + 1].map(|row| corner.y + row as f64 * pixel);
            let _ = write!(path, "M{left:.2} {top:.2}H{right:.2}V{bottom:.2}H{left:.2}z");
        }
    };
    for (column, row) in picture.pixels() {
        match &mut run {
            Some((_, to, of)) if *of == row && *to == column => *to += 1,
            _ => {
                close(run.take());
                run = Some((column, column + 1, row));
            }
        }
    }
    close(run);
    path
}

/// The sign of a missing picture.
fn empty(svg: &mut Svg, corner: Point, extent: Point) {
    svg.rectangle(corner, extent, &Paint::fill(WHITE).outlined(HAIRLINE, 1.0));
    let set = Type { anchor: Anchor::Middle, ..Type::new(11.0, MUTED) };
    svg.text(&font::shortened("no picture", 11.0, extent.x), corner + extent / 2.0, &set);
}

/// The time of day of a moment, whose date the subtitle has.
fn time_of(at: &str) -> &str {
    at.split_once(' ').map_or(at, |(_, time)| time)
}

/// The same in words.
fn told(strip: &SilhouetteStrip) -> String {
    let mut words = String::new();
    for moment in &strip.moments {
        let seen = strip.cameras.iter().zip(&moment.silhouettes).map(|((name, _), silhouette)| {
            let area_px = silhouette.as_ref().map_or(0, Silhouette::area_px);
            if area_px == 0 { format!("{name} no picture") } else { format!("{name} {area_px} pixels of somebody") }
        });
        let _ = writeln!(words, "{}: {}", moment.at, seen.collect::<Vec<_>>().join(", "));
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture() -> Silhouette {
        let mut picture = Silhouette::new(20, 16);
        (3..7).for_each(|column| picture.set(column, 2, true));
        picture.set(19, 15, true);
        picture
    }

    /// The pixels of a PNG's frames, a byte each.
    fn decoded(bytes: &[u8], frames: usize) -> Vec<Vec<u8>> {
        let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        decoder.set_transformations(png::Transformations::IDENTITY);
        let mut reader = decoder.read_info().unwrap();
        let (width, depth) = (reader.info().width as usize, reader.info().bit_depth as usize);
        let mut all = Vec::new();
        for _ in 0..frames {
            let mut data = vec![0; reader.output_buffer_size().unwrap()];
            let line = reader.next_frame(&mut data).unwrap().line_size;
            let pixel =
                |row: &[u8], at: usize| row[at * depth / 8] >> (8 - depth - at * depth % 8) & ((1 << depth) - 1);
            all.push(data.chunks(line).flat_map(|row| (0..width).map(move |at| pixel(row, at))).collect());
        }
        all
    }

    #[test]
    fn a_png_has_the_pixels_of_the_silhouette_enlarged() {
        let bytes = silhouette_png(&picture(), 3).unwrap();
        let [pixels] = &decoded(&bytes, 1)[..] else { panic!() };
        assert_eq!(pixels.len(), 60 * 48);
        for (at, &pixel) in pixels.iter().enumerate() {
            assert_eq!(pixel != 0, picture().is_set(at % 60 / 3, at / 60 / 3), "{at}");
        }
        assert!(matches!(silhouette_png(&picture(), 2000), Err(PngError::Size { .. })));
    }

    #[test]
    fn a_film_has_all_cameras_side_by_side_and_all_frames() {
        let sizes = [[20, 16], [10, 8]];
        let frames = [
            FilmFrame { silhouettes: vec![Some(picture()), None], lasts_ms: 200 },
            FilmFrame { silhouettes: vec![None, Some(Silhouette::new(10, 8))], lasts_ms: 1000 },
        ];
        let bytes = silhouette_film(&sizes, &frames, 2).unwrap();
        let pixels = decoded(&bytes, 2);
        let at = |frame: usize, column: usize, row: usize| pixels[frame][row * 2 * 66 + column * 2];
        assert_eq!([at(0, 3, 2), at(0, 2, 2), at(0, 20, 2), at(0, 23, 2)], [BODY, GROUND, BETWEEN, NONE]);
        assert_eq!([at(1, 3, 2), at(1, 23, 2), at(1, 23, 8)], [NONE, GROUND, BETWEEN]);
        assert!(matches!(silhouette_film(&sizes, &[], 2), Err(PngError::Size { .. })));
    }

    #[test]
    fn a_strip_says_what_it_shows_and_can_be_drawn() {
        let moment = |at: &str, silhouette| StripMoment { at: at.into(), silhouettes: vec![silhouette, None] };
        let strip = SilhouetteStrip {
            name: "a <run>".into(),
            cameras: vec![("east".into(), [20, 16]), ("west".into(), [20, 16])],
            moments: vec![moment("2025-06-02 08:00:00", Some(picture())), moment("2025-06-02 08:00:01", None)],
        };
        let svg = silhouette_strip(&strip);
        assert!(svg.contains("2 moments from 2025-06-02 08:00:00 on") && svg.contains(">08:00:01<"), "{svg}");
        assert!(svg.contains("08:00:00: east 5 pixels of somebody, west no picture"), "{svg}");
        assert_eq!(svg.matches(">no picture<").count(), 3);
        super::super::png(&svg, 600).unwrap();
    }
}
