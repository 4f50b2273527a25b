//! Maps that are read in slices: the same maps as at once, in steps of a bounded size, and given up without a trace.

use crate::common::seeded;
use motion::geom::se2::SE2;
use motion::map::{
    FloorPlan, FloorPlanError, Image, Interpretation, MapError, MapReading, Mode, OccupancyGrid, Pixel,
    Unknown, read_pgm,
};
use motion::sim::squeeze::{MapSqueeze, Settings};
use rand::Rng;

const RESOLUTION: f64 = 0.1;
const SLICE: usize = 50_000;
const SMALL: usize = 16;

fn origin() -> SE2 {
    SE2::new(-1.0, 2.0, 0.3)
}

/// Up to `n`.
fn below(rng: &mut impl Rng, n: u32) -> usize {
    (rng.next_u32() % n) as usize
}

/// A file, or the colours of pixels.
enum Source {
    File(Vec<u8>),
    Colours(Image<Vec<u8>>),
}

impl Source {
    /// Of up to 100 × 100 pixels in a few shades.
    fn random(rng: &mut impl Rng) -> Self {
        let [width, height] = [0; 2].map(|_| 1 + below(rng, 100));
        let shades = [0u8, 100, 205, 254];
        let mut shade = || usize::from(shades[below(rng, 4)]);
        let values: Vec<usize> = (0..width * height).map(|_| shade()).collect();
        let opaque = below(rng, 2) == 0;
        let text =
            |magic: &str, greatest: usize| format!("{magic} {width} {height} {greatest}\n").into_bytes();
        match below(rng, 4) {
            0 => {
                let numbers: Vec<String> = values.iter().map(ToString::to_string).collect();
                Self::File([text("P2", 255), numbers.join("\n").into_bytes()].concat())
            }
            1 => Self::File([text("P5", 255), values.iter().map(|value| *value as u8).collect()].concat()),
            2 => {
                let words = values.iter().flat_map(|value| (257 * *value as u16).to_be_bytes());
                Self::File([text("P5", 65_535), words.collect()].concat())
            }
            _ => {
                let opacity = |value: u8| if opaque || value > 100 { 255 } else { value };
                let colours = values.iter().map(|value| *value as u8);
                let pixels = colours.flat_map(|value| [value, value, value / 2, opacity(value)]).collect();
                Self::Colours(Image { width, height, pixels })
            }
        }
    }

    fn reading(&self, interpretation: &Interpretation) -> MapReading {
        match self {
            Self::File(file) => MapReading::of_pgm(file.clone(), interpretation, RESOLUTION, origin()),
            Self::Colours(image) => {
                Ok(MapReading::of_colours(image.clone(), interpretation, RESOLUTION, origin()))
            }
        }
        .expect("an image")
    }

    fn grid(&self, interpretation: &Interpretation) -> OccupancyGrid {
        match self {
            Self::File(file) => {
                let image = read_pgm(file).expect("an image");
                OccupancyGrid::new(&image, interpretation, RESOLUTION, origin())
            }
            Self::Colours(Image { width, height, pixels }) => {
                let pixel = |colours: &[u8]| {
                    let [red, green, blue, opacity] = [0, 1, 2, 3].map(|i| f32::from(colours[i]));
                    Pixel { shade: (red + green + blue) / 765.0, opacity: opacity / 255.0 }
                };
                let pixels: Vec<Pixel> = pixels.chunks(4).map(pixel).collect();
                let image = Image { width: *width, height: *height, pixels };
                OccupancyGrid::new(&image, interpretation, RESOLUTION, origin())
            }
        }
    }
}

/// However it is sliced, and also where the unknown cells become something else meanwhile.
#[test]
fn a_map_is_the_same_in_slices() {
    let mut rng = seeded(9950);
    let (mut unknown_cells, mut several) = (0, 0);
    for _ in 0..1000 {
        let source = Source::random(&mut rng);
        let mode = [Mode::Trinary, Mode::Scale, Mode::Raw][below(&mut rng, 3)];
        let interpretation =
            Interpretation { mode, negate: below(&mut rng, 4) == 0, ..Interpretation::default() };
        let mut reading = source.reading(&interpretation);
        let mut unknown = Unknown::Free;
        let (mut slices, mut told) = (1, reading.done());
        assert_eq!(told, 0.0);
        while !reading.advance(unknown, &mut (1 + below(&mut rng, 300))).expect("an image") {
            if below(&mut rng, 4) == 0 {
                unknown = [Unknown::Free, Unknown::Blocked][below(&mut rng, 2)];
            }
            slices += 1;
            told = reading.done();
            assert!((0.0..1.0).contains(&told), "{told}");
        }
        assert_eq!(reading.done(), 1.0, "after {told}");
        let plan = reading.finish().expect("few walls");
        let expected =
            FloorPlan::from_grid(source.grid(&interpretation).with_unknown(unknown)).expect("few walls");
        assert_eq!(
            (plan.grid(), plan.walls(), plan.bounds()),
            (expected.grid(), expected.walls(), expected.bounds())
        );
        unknown_cells += usize::from(unknown == Unknown::Blocked);
        several += usize::from(slices > 4);
    }
    assert!(unknown_cells > 200 && several > 500, "{unknown_cells} {several}");
}

/// A map of 4096 × 1024 pixels with a wall around it.
fn hall(plain: bool) -> Vec<u8> {
    let (width, height) = (4096, 1024);
    let is_wall = |i: usize| i < width || i >= width * (height - 1) || [0, width - 1].contains(&(i % width));
    let header = format!("{} {width} {height} 255\n", if plain { "P2" } else { "P5" });
    let mut file = header.into_bytes();
    for i in 0..width * height {
        if plain {
            file.extend_from_slice(if is_wall(i) { b"0 " } else { b"254 " });
        } else {
            file.push(if is_wall(i) { 0 } else { 254 });
        }
    }
    file
}

/// A plain pixel counts as a distance, eight others too, and eight cells where outlines are followed; a slice goes beyond what is
/// allowed by what is read at once, 256 pixels or a row, and that is all.
#[test]
fn no_slice_is_longer_than_allowed() {
    const PIXELS: usize = 4096 * 1024;
    for (plain, cost) in [(true, PIXELS + PIXELS / 8), (false, PIXELS / 8 + PIXELS / 8)] {
        let mut reading = MapReading::of_pgm(hall(plain), &Interpretation::default(), 0.01, SE2::identity())
            .expect("an image");
        let (mut slices, mut last) = (0, 0.0);
        loop {
            let mut work = SLICE;
            let done = reading.advance(Unknown::Free, &mut work).expect("an image");
            slices += 1;
            assert!(reading.done() > last, "{last}");
            last = reading.done();
            if done {
                break;
            }
            assert_eq!(work, 0, "a slice stopped short");
        }
        let fewest = cost / (SLICE + 4096 / 8 + 1);
        assert!((fewest..=cost / SLICE + 3).contains(&slices), "{slices} slices; {fewest} at least");
        assert_eq!(reading.finish().expect("a room").walls().len(), 8);
    }
}

fn settings() -> Settings {
    Settings { samples: 200, ..Settings::default() }
}

fn begun(machine: &mut MapSqueeze, file: &[u8]) {
    machine.begin_map(
        MapReading::of_pgm(file.to_vec(), &Interpretation::default(), 1.0, SE2::identity())
            .expect("a header"),
    );
}

/// A square room around the opening start, plain, whose last pixel is a text.
fn room(last: &str) -> Vec<u8> {
    let pixels = [
        "0 0 0 0 0 0 0",
        "0 9 9 9 9 9 0",
        "0 9 9 9 9 9 0",
        "0 9 9 9 9 9 0",
        "0 9 9 9 9 9 0",
        "0 9 9 9 9 9 0",
        "0 0 0 0 0 0",
    ];
    format!("P2\n7 7\n9\n{}\n{last}\n", pixels.join("\n")).into_bytes()
}

fn finish(machine: &mut MapSqueeze) -> Result<usize, MapError> {
    for slices in 1.. {
        if machine.advance(SMALL)? {
            return Ok(slices);
        }
        assert!((0.0..=1.0).contains(&machine.progress()));
    }
    unreachable!("all slices")
}

/// What a machine shows.
fn shown(machine: &MapSqueeze) -> String {
    format!(
        "{:?} {:?} {:?} {:?}",
        machine.plan().walls(),
        machine.settings(),
        machine.attempts(),
        machine.tally()
    )
}

/// Also when it has been read, and is being looked at.
#[test]
fn a_map_on_its_way_is_given_up() {
    let mut machine = MapSqueeze::new(settings()).expect("valid");
    let before = shown(&machine);
    begun(&mut machine, &room("0"));
    let slices = finish(&mut machine.clone()).expect("a map");
    for patience in (0..slices - 1).step_by(1 + slices / 20) {
        begun(&mut machine, &room("0"));
        for _ in 0..patience {
            assert_eq!(machine.advance(SMALL), Ok(false));
        }
        machine.stop();
        assert_eq!(shown(&machine), before, "after {patience} of {slices} slices");
    }
    assert_eq!(finish(&mut machine), Ok(1), "nothing is left of them");
}

#[test]
fn what_is_refused_late_changes_nothing() {
    let mut machine = MapSqueeze::new(settings()).expect("valid");
    let before = shown(&machine);
    begun(&mut machine, &room("ten"));
    let error = finish(&mut machine).expect_err("no number");
    assert_eq!(error.to_string(), r#"line 11: a pixel is "ten"; allowed is a whole number from 0 to 9"#);
    assert_eq!(shown(&machine), before);
    // Cells that lie apart.
    let pixels = (0..640 * 320).map(|i| if (i % 2, i / 640 % 2) == (0, 0) { 0 } else { 255 });
    let file = [b"P5 640 320 255\n".to_vec(), pixels.collect()].concat();
    begun(&mut machine, &file);
    assert_eq!(
        finish(&mut machine),
        Err(MapError::Plan(FloorPlanError::TooManySides(FloorPlan::MAX_WALLS + 1)))
    );
    assert_eq!(shown(&machine), before);
    assert_eq!(finish(&mut machine), Ok(1));
}

/// The last map that is asked for is the one that is there; what else is asked for meanwhile is about the present one.
#[test]
fn the_last_map_wins() {
    let mut machine = MapSqueeze::new(settings()).expect("valid");
    begun(&mut machine, &room("ten"));
    begun(&mut machine, &room("0"));
    assert_eq!(machine.advance(1), Ok(false));
    let other = Settings { clearance: 0.2, seed: 5, ..settings() };
    machine.configure(other).expect("valid");
    assert_eq!(shown(&machine), shown(&MapSqueeze::new(other).expect("valid")));
    assert!(finish(&mut machine).is_ok());
    let mut expected = MapSqueeze::new(other).expect("valid");
    expected.set_plan(machine.plan().clone());
    assert_eq!((shown(&machine), machine.plan().walls().len()), (shown(&expected), 8));

    begun(&mut machine, &room("ten"));
    machine.set_plan(FloorPlan::apartment());
    assert_eq!(finish(&mut machine), Ok(1));
    assert_eq!(shown(&machine), shown(&MapSqueeze::new(other).expect("valid")));
}
