//! An animation as GIF: of each picture what has changed, in 255 colours.

use std::collections::{BTreeMap, HashMap};

use crate::png::Picture;
use ::gif::{DisposalMethod, Encoder, Frame, Repeat};

use crate::animation::{Animation, RATE, STAYS};
use crate::shown::WIDTH;
use crate::style::{Ground, Role};

/// Width of the picture [px].
const PIXELS: f64 = 800.0;
/// The code of a pixel that stays as it is.
const SAME: u8 = 255;

type Pixel = [u8; 3];

impl Animation {
    /// The animation as GIF, 800 pixels wide, ten pictures a second, again and again.
    ///
    /// * `go_on`: called before each picture
    ///
    /// # Panics
    ///
    /// Never: memory takes all that is written.
    #[must_use]
    pub fn to_gif(&self, ground: Ground, go_on: &mut dyn FnMut()) -> Vec<u8> {
        let mut palette = Palette::new(ground);
        let picture = |index| self.picture(index, ground).to_picture(PIXELS / WIDTH);
        // The last has all that there is.
        let (first, last) = (picture(0), picture(self.len() - 1));
        palette.choose([&first, &last]);
        let size = [first.width, first.height].map(narrow);
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, size[0], size[1], &palette.bytes())
            .expect("memory takes what is written");
        encoder.set_repeat(Repeat::Infinite).expect("memory takes what is written");
        let mut shown: Option<Vec<u8>> = None;
        for (index, picture) in self.pictures(ground, PIXELS / WIDTH).enumerate() {
            go_on();
            let codes = palette.codes(&picture);
            let is_last = index + 1 == self.len();
            let pictures = if is_last { STAYS } else { 1 };
            let mut frame = changed(shown.as_deref(), &codes, size);
            frame.delay = hundredths(f64::from(pictures) / RATE);
            frame.dispose = DisposalMethod::Keep;
            frame.transparent = Some(SAME);
            encoder.write_frame(&frame).expect("memory takes what is written");
            shown = Some(codes);
        }
        drop(encoder);
        bytes
    }
}

/// The rectangle in which something has changed; a pixel where nothing has.
fn changed(shown: Option<&[u8]>, codes: &[u8], [width, height]: [u16; 2]) -> Frame<'static> {
    let across = usize::from(width);
    let Some(shown) = shown else {
        return Frame { width, height, buffer: codes.to_vec().into(), ..Frame::default() };
    };
    let differing = (0..codes.len()).filter(|&at| codes[at] != shown[at]);
    let around = differing.fold(None, |around: Option<[usize; 4]>, at| {
        let (x, y) = (at % across, at / across);
        let [left, top, right, bottom] = around.unwrap_or([x, y, x, y]);
        Some([left.min(x), top.min(y), right.max(x), bottom.max(y)])
    });
    let [left, top, right, bottom] = around.unwrap_or([0; 4]);
    let buffer: Vec<u8> = (top..=bottom)
        .flat_map(|y| (left..=right).map(move |x| y * across + x))
        .map(|at| if codes[at] == shown[at] { SAME } else { codes[at] })
        .collect();
    let narrow = |count: usize| u16::try_from(count).unwrap_or(u16::MAX);
    Frame {
        left: narrow(left),
        top: narrow(top),
        width: narrow(right - left + 1),
        height: narrow(bottom - top + 1),
        buffer: buffer.into(),
        ..Frame::default()
    }
}

fn narrow(count: u32) -> u16 {
    u16::try_from(count).unwrap_or(u16::MAX)
}

/// A time in hundredths of a second, as GIF counts it.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
fn hundredths(time: f64) -> u16 {
    (100.0 * time).round() as u16
}

/// The colours of all pictures.
struct Palette {
    colours: Vec<Pixel>,
    codes: HashMap<Pixel, u8>,
}

impl Palette {
    /// Those of all roles.
    fn new(ground: Ground) -> Self {
        let mut palette = Self { colours: Vec::new(), codes: HashMap::new() };
        for role in Role::ALL {
            palette.add(role.on(ground).bytes());
        }
        palette
    }

    fn add(&mut self, colour: Pixel) {
        let is_new = !self.colours.contains(&colour);
        if is_new && self.colours.len() < usize::from(SAME) {
            self.colours.push(colour);
        }
    }

    /// Adds the mixtures that pictures have most of.
    fn choose(&mut self, pictures: [&Picture; 2]) {
        let mut counts: BTreeMap<Pixel, (u32, Pixel)> = BTreeMap::new();
        for pixel in pictures.iter().flat_map(|picture| &picture.pixels) {
            // Those that no eye tells apart count together.
            let count = counts.entry(pixel.map(|part| part >> 4)).or_insert((0, *pixel));
            count.0 += 1;
        }
        let mut counts: Vec<(u32, Pixel)> = counts.into_values().collect();
        counts.sort_by_key(|(count, pixel)| (std::cmp::Reverse(*count), *pixel));
        for (_, pixel) in counts {
            self.add(pixel);
        }
    }

    fn codes(&mut self, picture: &Picture) -> Vec<u8> {
        let Self { colours, codes } = self;
        let nearest = |pixel: Pixel| {
            let far = |colour: &Pixel| -> i32 {
                let gaps = [0, 1, 2].map(|k| i32::from(colour[k]) - i32::from(pixel[k]));
                // How strongly an eye sees each.
                3 * gaps[0] * gaps[0] + 6 * gaps[1] * gaps[1] + gaps[2] * gaps[2]
            };
            let place = (0..colours.len()).min_by_key(|place| far(&colours[*place]));
            u8::try_from(place.unwrap_or(0)).unwrap_or(0)
        };
        // Most pixels are as the one before.
        let mut last: Option<(Pixel, u8)> = None;
        let pixels = picture.pixels.iter().map(|&pixel| {
            if let Some((_, code)) = last.filter(|(before, _)| *before == pixel) {
                return code;
            }
            let code = *codes.entry(pixel).or_insert_with(|| nearest(pixel));
            last = Some((pixel, code));
            code
        });
        pixels.collect()
    }

    /// Red, green and blue of all, one after the other.
    fn bytes(&self) -> Vec<u8> {
        let mut bytes: Vec<u8> = self.colours.iter().flatten().copied().collect();
        // The code of what stays needs a place in the table too.
        bytes.resize(3 * 256, 0);
        bytes
    }
}
