"""Interactive figures of probabilistic motion models, for notebooks."""

from ._elements import *
from ._elements import __all__ as __all__
