//! Law of the reader of map files in PGM format.

use super::doubles::new_proptest_config;
use motion::map::read_pgm;
use proptest::collection::vec;
use proptest::prelude::*;

fn any_separator() -> impl Strategy<Value = String> {
    prop_oneof![
        "[ \t\r\n]{1,3}",
        "[ ]?#[ -~]{0,12}\n",
        Just("\n# made by a program\n# in two lines\n".to_owned()),
    ]
}

proptest! {
    #![proptest_config(new_proptest_config(250))]

    /// The image depends neither on white space and comments in the file, nor on the kind of the file (plain or binary).
    #[test]
    fn pgm_headers_may_have_any_white_space_and_comments(
        (width, height) in (1..6usize, 1..6usize), max_value in 1..=65_535u32, grey_seeds in vec(any::<u32>(), 36),
        word_separators in vec(any_separator(), 40), cut_position in any::<usize>(),
    ) {
        let grey_values: Vec<u32> = grey_seeds.into_iter().take(width * height).map(|grey_seed| grey_seed % (max_value + 1)).collect();
        let mut plain_pgm = "P2".to_owned();
        for (grey_or_header_value, word_separator) in [width as u32, height as u32, max_value].iter().chain(&grey_values).zip(&word_separators) {
            plain_pgm.push_str(word_separator);
            plain_pgm.push_str(&grey_or_header_value.to_string());
        }
        let mut binary_pgm = format!("P5{}{width}{}{height}{}{max_value}\n", word_separators[0], word_separators[1], word_separators[2]).into_bytes();
        for grey_value in &grey_values {
            let bytes_of_number = grey_value.to_be_bytes();
            binary_pgm.extend(if max_value < 256 { &bytes_of_number[3..] } else { &bytes_of_number[2..] });
        }
        let plain_image = read_pgm(plain_pgm.as_bytes()).expect("a plain file");
        prop_assert!(plain_image.pixels == read_pgm(&binary_pgm).expect("a binary file").pixels);
        prop_assert_eq!((plain_image.width, plain_image.height), (width, height));
        for (pixel_shade, grey_value) in plain_image.pixels.iter().zip(&grey_values) {
            prop_assert_eq!(*pixel_shade, *grey_value as f32 / max_value as f32);
        }
        prop_assert!(read_pgm(&binary_pgm[..cut_position % binary_pgm.len()]).is_err());
        let start_of_last_number = plain_pgm.trim_end_matches(|c: char| c.is_ascii_digit()).len();
        prop_assert!(read_pgm(&plain_pgm.as_bytes()[..cut_position % (start_of_last_number + 1)]).is_err());
    }
}
