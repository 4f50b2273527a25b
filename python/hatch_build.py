"""Build hook that fails if generated files are missing."""

from pathlib import Path

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

GENERATED_FILES = ["src/motion_widgets/_elements.py", "src/motion_widgets/anywidget.js", "LICENSE-MIT", "LICENSE-APACHE", "LICENSE-third-party.txt"]


class CheckGeneratedFiles(BuildHookInterface):
    def initialize(self, version, build_data):
        missing_paths = [path for path in GENERATED_FILES if not (Path(self.root) / path).exists()]
        if missing_paths:
            raise FileNotFoundError(f"{' and '.join(missing_paths)} are missing in python/: `npm run build` in the directory above makes them.")
