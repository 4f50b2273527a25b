//! Search for printed numbers in the text of a page or a document, for comparison with computed numbers.

/// Text of a page or a document, joined to one line.
pub struct PlainText(String);

#[derive(Clone, Copy, Debug)]
pub struct PrintedNumber {
    pub value: f64,
    /// Rounding error of the printed number: half a unit of its last digit.
    pub rounding_error: f64,
}

impl PrintedNumber {
    /// Asserts that the printed number equals a computed one, within `tolerance` and the rounding of the last printed digit.
    pub fn assert_near(&self, computed_value: f64, tolerance: f64) {
        let absolute_error = (computed_value - self.value).abs();
        assert!(
            absolute_error <= self.rounding_error * (1.0 + 1e-9) + tolerance,
            "{computed_value} ± {tolerance} is printed as {}",
            self.value
        );
    }

    pub fn assert_percent(&self, computed_fraction: f64, tolerance: f64) {
        self.assert_near(100.0 * computed_fraction, 100.0 * tolerance);
    }
}

const THIN_SPACE: char = '\u{202f}';

impl PlainText {
    pub fn from_page(markdown_page: &str) -> Self {
        let mut plain_text = String::new();
        for tag_and_text in markdown_page.split('<') {
            plain_text
                .push_str(tag_and_text.split_once('>').map_or(tag_and_text, |(_, plain_part)| plain_part));
        }
        for (markup_text, replacement_text) in [("*", ""), ("&nbsp;", " "), ("&#8239;", "\u{202f}")] {
            plain_text = plain_text.replace(markup_text, replacement_text);
        }
        Self::from_document(&plain_text)
    }

    pub fn from_document(text: &str) -> Self {
        Self(text.split([' ', '\n', '\t']).filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" "))
    }

    /// Returns the numbers that stand at each `#` of a sentence. The text must contain the sentence exactly once.
    pub fn sentence_numbers<const N: usize>(&self, sentence_pattern: &str) -> [PrintedNumber; N] {
        let sentence_parts: Vec<&str> = sentence_pattern.split('#').collect();
        assert_eq!(sentence_parts.len(), N + 1, "numbers in: {sentence_pattern}");
        let number_lists: Vec<Vec<PrintedNumber>> = self
            .0
            .match_indices(sentence_parts[0])
            .filter_map(|(sentence_start, _)| parse_numbers(&self.0[sentence_start..], &sentence_parts))
            .collect();
        assert_eq!(number_lists.len(), 1, "times that the text says: {sentence_pattern}");
        std::array::from_fn(|i| number_lists[0][i])
    }

    pub fn assert_numbers<const N: usize>(&self, sentence_pattern: &str, computed_numbers: [f64; N]) {
        self.sentence_numbers::<N>(sentence_pattern)
            .iter()
            .zip(computed_numbers)
            .for_each(|(printed_number, computed_value)| printed_number.assert_near(computed_value, 0.0));
    }

    pub fn assert_contains(&self, sentence_pattern: &str) {
        let [] = self.sentence_numbers(sentence_pattern);
    }
}

fn is_group_of_thousands(word: &str) -> bool {
    let word_digits = word.trim_end_matches([',', '.', ':']);
    word_digits.len() == 3 && word_digits.chars().all(|c| c.is_ascii_digit())
}

/// Returns the numbers that a text has between the given parts of a sentence, or None if the text begins otherwise.
fn parse_numbers(remaining_text: &str, sentence_parts: &[&str]) -> Option<Vec<PrintedNumber>> {
    let mut remaining_text = remaining_text.strip_prefix(sentence_parts[0])?;
    sentence_parts[1..]
        .iter()
        .map(|sentence_part| {
            let is_in_number = |c: char| c.is_ascii_digit() || ['−', '.', THIN_SPACE].contains(&c);
            let mut number_end = remaining_text.find(|c| !is_in_number(c)).unwrap_or(remaining_text.len());
            // In documents, a plain space may separate thousands.
            if remaining_text[number_end..].starts_with(' ')
                && remaining_text[number_end + 1..].split(' ').next().is_some_and(is_group_of_thousands)
            {
                number_end += 4;
            }
            number_end -= usize::from(remaining_text[..number_end].ends_with('.'));
            let number_digits: String =
                remaining_text[..number_end].replace('−', "-").replace([THIN_SPACE, ' '], "");
            let decimal_count =
                number_digits.split_once('.').map_or(0, |(_, decimal_digits)| decimal_digits.len() as i32);
            remaining_text = remaining_text[number_end..].strip_prefix(sentence_part)?;
            Some(PrintedNumber {
                value: number_digits.parse().ok()?,
                rounding_error: 0.5 * 10f64.powi(-decimal_count),
            })
        })
        .collect()
}
