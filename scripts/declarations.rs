//! Prints the constants of build/settings.js as JSON: all settings with their presets, and limits. Pages need them before they
//! load the core. `scripts/build.mjs` runs this program.

use motion::map::{MAX_BYTES, MAX_PIXELS};
use motion::sim::picture::RAMP_STEP_COUNT;
use motion::sim::settings::{Setting, SettingRules};
use motion::sim::squeeze::{ACCEPTED_BIT, END_FREE_BIT, MAX_TRIAL_PARTS, PATH_FREE_BIT};
use motion::sim::{alpha_calibrator, arc_anatomy, banana, dead_reckoning, odometry_decomposer, squeeze};
use serde_json::json;
use serde_json::value::{RawValue, to_raw_value};

fn main() -> serde_json::Result<()> {
    let widget_declarations = [
        describe_widget::<banana::Settings>("banana-machine")?,
        describe_widget::<squeeze::Settings>("map-squeeze")?,
        describe_widget::<arc_anatomy::Settings>("arc-anatomy")?,
        describe_widget::<odometry_decomposer::Settings>("odometry-decomposer")?,
        describe_widget::<dead_reckoning::Settings>("dead-reckoning")?,
        describe_widget::<alpha_calibrator::Settings>("alpha-calibrator")?,
    ];
    let banana::Settings { velocity_alphas, odometry_alphas, .. } = banana::Settings::DEFAULT;
    let core_constants = json!({
        // Initial noise parameters of each model.
        "openingAlphas": { "velocity": velocity_alphas, "odometry": odometry_alphas },
        // Limits of files and calls. `cells`: number of cells of a grid and of pixels of an image. `bytes`: size of an image file. `trial`:
        // product of samples and parts in a call of `MapSqueeze.trial`. `ramp`: number of colours of a ramp.
        "limits": { "cells": MAX_PIXELS, "bytes": MAX_BYTES, "trial": MAX_TRIAL_PARTS, "ramp": RAMP_STEP_COUNT },
        // Bit flags of the verdict on an attempt of Map Squeeze to draw a motion.
        "verdict": { "endFree": END_FREE_BIT, "pathFree": PATH_FREE_BIT, "accepted": ACCEPTED_BIT },
    });
    println!("{}", serde_json::to_string(&(widget_declarations, core_constants))?);
    Ok(())
}

/// Returns the tag of a widget, its settings and its presets as JSON. Each setting has its declaration, its type with the allowed values,
/// and its default.
fn describe_widget<S: SettingRules>(widget_tag: &'static str) -> serde_json::Result<Box<RawValue>> {
    let mut settings = Vec::new();
    S::default().try_visit_settings(|declaration, setting| {
        let setting_type = match &setting {
            Setting::Number(_, allowed) => json!({ "type": "number", "allowed": allowed }),
            Setting::Integer(_, allowed) => json!({ "type": "whole", "allowed": allowed }),
            Setting::OptionalInteger(_, allowed) => {
                json!({ "type": "whole", "allowed": allowed, "nullable": true })
            }
            Setting::Boolean(_) => json!({ "type": "boolean" }),
            Setting::Keyword(setting_keyword) => json!({ "type": "word", "words": setting_keyword.all_keywords() }),
            Setting::Numbers(_, allowed) => {
                json!({ "type": "numbers", "allowed": allowed, "minLength": find_min_length::<S>(declaration.key) })
            }
            Setting::Level(noise_level, allowed) => {
                let alpha_weights: Vec<_> = noise_level.alpha_ratios().collect();
                json!({ "type": "number", "allowed": allowed, "nullable": true, "weights": alpha_weights })
            }
            Setting::Group(group_members, _) => {
                let member_fields = group_members.each_ref().map(|group_member| (&group_member.declaration, &group_member.allowed));
                json!({ "type": "group", "fields": member_fields })
            }
        };
        settings.push(to_raw_value(&(declaration, setting_type, &setting))?);
        Ok(())
    })?;
    to_raw_value(&(widget_tag, settings, S::PRESETS))
}

/// Returns the minimum length of a list setting whose length depends on a preceding keyword, such as the motion model.
fn find_min_length<S: SettingRules>(list_key: &str) -> usize {
    let mut find_min_length = usize::MAX;
    S::default().visit_settings(&mut |keyword_declaration, setting| {
        let Setting::Keyword(setting_keyword) = setting else { return };
        for allowed_keyword in setting_keyword.all_keywords() {
            S::default().visit_settings(&mut |declaration, setting| match setting {
                Setting::Keyword(setting_keyword) if declaration.key == keyword_declaration.key => {
                    assert!(setting_keyword.set(allowed_keyword))
                }
                Setting::Numbers(listed_numbers, _) if declaration.key == list_key => {
                    find_min_length = find_min_length.min(listed_numbers.len());
                }
                _ => {}
            });
        }
    });
    find_min_length
}
