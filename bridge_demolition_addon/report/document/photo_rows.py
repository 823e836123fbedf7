"""What pages show as pictures: drawings, and photos beside each other."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import groupby

from matplotlib.figure import Figure
from matplotlib.image import imread
from PIL import Image

from ...charts.style import MM_PER_INCH, PAGE_WIDTH_MM, POINTS_PER_INCH, blank_figure
from .blocks import AnimatedModel, Block, DataTable, Listing, Paragraph, Photo, Picture
from .page_style import BOTTOM_MM, LINE, SMALL, TOP_MM
from .wrapping import wrapped

SMALLEST_SCALE = 0.8
"""Of a drawing that is made smaller so that it fits on the rest of a page: its letters can still be read."""

_PHOTOS_ABREAST = 2
PHOTO_GAP_MM = 4.0

PHOTO_DOTS_PER_INCH = 150.0


@dataclass(frozen=True, slots=True)
class PhotoRow:
    """Photos that stand beside each other."""

    photos: tuple[Photo, ...]

    @property
    def gaps_mm(self) -> float:
        return (len(self.photos) - 1) * PHOTO_GAP_MM

    @property
    def width_mm(self) -> float:
        """Width of each."""
        return (PAGE_WIDTH_MM - self.gaps_mm) / len(self.photos)


Drawn = Picture | PhotoRow
Shown = Paragraph | Listing | DataTable | Drawn


def abreast(blocks: Iterable[Block]) -> Iterator[Shown]:
    """Yield blocks with photos that follow each other side by side, and without what paper does not show."""
    on_paper = (block for block in blocks if not isinstance(block, AnimatedModel))
    for is_photo, run in groupby(on_paper, key=lambda block: isinstance(block, Photo)):
        if is_photo:
            photos = [block for block in run if isinstance(block, Photo)]
            for first in range(0, len(photos), _PHOTOS_ABREAST):
                yield PhotoRow(tuple(photos[first : first + _PHOTOS_ABREAST]))
        else:
            yield from (block for block in run if not isinstance(block, Photo | AnimatedModel))


def drawn_height_mm(block: Drawn) -> float:
    """Return how high a block is as it is drawn, without its caption."""
    if isinstance(block, Picture):
        return block.height_mm
    return max(_photo_mm(photo, block.width_mm)[1] for photo in block.photos)


def caption_mm(block: Drawn) -> float:
    """Return what the caption of a block takes, with the room around it."""
    if isinstance(block, Picture):
        lines = len(list(wrapped(block.title, PAGE_WIDTH_MM, SMALL)))
    else:
        width_mm = SMALLEST_SCALE * block.width_mm
        lines = max(len(list(wrapped(photo.title, width_mm, SMALL))) for photo in block.photos)
    return 1.0 + lines * LINE * SMALL.height_mm


def _photo_mm(photo: Photo, width_mm: float) -> tuple[float, float]:
    """Return the width and height of a photo that is not to be wider, and not higher than a page."""
    with Image.open(photo.path) as image:
        width, height = image.size
    return width_mm, min(width_mm * height / width, BOTTOM_MM - TOP_MM - 20.0)


def photo_drawn(photo: Photo, width_mm: float) -> Figure:
    """Return a photo as a figure of this width, with no more dots than paper shows."""
    pixels, (width_mm, height_mm) = imread(photo.path), _photo_mm(photo, width_mm)
    drawn = blank_figure(width_mm / MM_PER_INCH, height_mm / MM_PER_INCH, dpi=POINTS_PER_INCH)
    axes = drawn.add_axes((0.0, 0.0, 1.0, 1.0))
    step = max(1, int(pixels.shape[1] / (width_mm / MM_PER_INCH * PHOTO_DOTS_PER_INCH)))
    axes.imshow(pixels[::step, ::step])
    axes.set_axis_off()
    return drawn
