//! Pictures of LEDs, and their blobs by another way: a flood fill over the whole picture.

#![allow(dead_code, missing_docs, unreachable_pub, clippy::missing_panics_doc, reason = "two tests use it")]

use tautline_kernel::perception::blob::{Blob, Colours, Picture, Pixel, Set, Thresholds, TooManySets, find};

/// What an LED looks like.
pub const LED: Pixel = Pixel { y: 240, u: 90, v: 200 };
/// What is around it.
pub const FLOOR: Pixel = Pixel { y: 80, u: 128, v: 128 };

/// A picture of which some pixels are those of an LED.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// Pixels in a line.
    pub width: u16,
    /// Line by line.
    pub lit: Vec<bool>,
}

impl Drawn {
    /// `x` is lit.
    pub fn from_rows(rows: &[&str]) -> Self {
        let lit = rows.iter().flat_map(|row| row.chars()).map(|symbol| symbol == 'x').collect();
        Self { width: rows[0].len() as u16, lit }
    }

    /// Lines.
    pub fn height(&self) -> u16 {
        (self.lit.len() / usize::from(self.width)) as u16
    }

    /// Whether a pixel is lit.
    pub fn is_lit(&self, column: u16, row: u16) -> bool {
        self.lit[usize::from(row) * usize::from(self.width) + usize::from(column)]
    }

    /// With unlit columns and rows before and after.
    pub fn framed(&self, left: u16, above: u16, right: u16, below: u16) -> Self {
        let (width, height) = (left + self.width + right, above + self.height() + below);
        let inside = |column: u16, row: u16| {
            (left..left + self.width).contains(&column) && (above..above + self.height()).contains(&row)
        };
        let cells = (0..height).flat_map(|row| (0..width).map(move |column| (column, row)));
        let lit = cells.map(|(column, row)| inside(column, row) && self.is_lit(column - left, row - above));
        Self { width, lit: lit.collect() }
    }

    fn pixels(&self) -> Vec<Pixel> {
        self.lit.iter().map(|&lit| if lit { LED } else { FLOOR }).collect()
    }

    /// What [`find`] finds, with room enough.
    pub fn blobs(&self, thresholds: Thresholds) -> Vec<Blob> {
        let most = thresholds.most_sets(self.width, self.height());
        self.blobs_with(thresholds, most).expect("sets enough")
    }

    /// What [`find`] finds, with room for so many sets.
    ///
    /// # Errors
    /// [`TooManySets`].
    pub fn blobs_with(&self, thresholds: Thresholds, sets: usize) -> Result<Vec<Blob>, TooManySets> {
        let pixels = self.pixels();
        let picture = Picture::new(&pixels, self.width).expect("a picture");
        let colours = Colours::new(LED, LED).expect("colours");
        Ok(find(picture, colours, thresholds, &mut vec![Set::UNUSED; sets])?.collect())
    }

    /// The blobs by filling the gaps in lines and flooding over columns, in the order of their first pixels: how many
    /// pixels, and the sums of their columns and rows.
    pub fn flooded(&self, thresholds: Thresholds) -> Vec<(u32, u64, u64)> {
        let gap = i32::from(thresholds.most_gap_pixels);
        let (width, height) = (i32::from(self.width), i32::from(self.height()));
        let lit =
            |column: i32, row: i32| (0..width).contains(&column) && self.is_lit(column as u16, row as u16);
        // A pixel is filled if it is lit, or in a gap that is short enough.
        let filled = |column: i32, row: i32| {
            let to_the_left = (0..=gap + 1).find(|&steps| lit(column - steps, row));
            let to_the_right = (0..=gap + 1).find(|&steps| lit(column + steps, row));
            to_the_left.zip(to_the_right).is_some_and(|(left, right)| left + right <= gap + 1)
        };
        let mut seen = vec![false; self.lit.len()];
        let mut blobs = Vec::new();
        for (column, row) in (0..height).flat_map(|row| (0..width).map(move |column| (column, row))) {
            let (mut pixels, mut columns, mut rows) = (0, 0, 0);
            let mut next = vec![(column, row)];
            while let Some((column, row)) = next.pop() {
                let place = (row * width + column) as usize;
                if seen[place] || !filled(column, row) {
                    continue;
                }
                seen[place] = true;
                if lit(column, row) {
                    (pixels, columns, rows) = (pixels + 1, columns + column as u64, rows + row as u64);
                }
                let beside =
                    [column - 1, column + 1].into_iter().filter(|column| (0..width).contains(column));
                next.extend(beside.map(|column| (column, row)));
                let near = (row - gap - 1).max(0)..=(row + gap + 1).min(height - 1);
                next.extend(near.map(|row| (column, row)));
            }
            if pixels >= thresholds.least_pixels.max(1) {
                blobs.push((pixels, columns, rows));
            }
        }
        blobs
    }
}

/// A mean of places, in 256ths.
pub fn rounded(sum: u64, pixels: u32) -> u32 {
    (f64::from(sum as u32) * 256.0 / f64::from(pixels)).round() as u32
}
