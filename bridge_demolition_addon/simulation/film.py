"""The film of a run: contours of stress on the simulated scene, in real time and in slow motion."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from pathlib import Path

import bpy

from ..core.film import PICTURES_PER_SECOND, film_plan
from ..core.results import Results
from ..report.film_pictures import lay_over, stress_colours, stress_scale
from ..scene.film import contour_shading, encode_film, render_coloured


def make_film(
    scene: bpy.types.Scene,
    results: Results,
    moment_s: float | None,
    path: Path,
    done: Callable[[int, int], None] = lambda *_: None,
) -> None:
    """Render a film of frames that were simulated already. Shards are coloured by stress, everything else is as it is.

    Parameters
    ----------
    scene
        The scene with its camera, as it was played.
    results
        What was recorded of it.
    moment_s
        The moment that slow motion is about; None for none.
    path
        File to write, MP4.
    done
        Told how many pictures are rendered, and how many there are to render.
    """
    plan, scale = film_plan(results.times_s, moment_s), stress_scale(results)
    shards = results.of_kind("shard")
    bodies = [scene.objects[str(name)] for name in results.body_names[shards]]
    kept = [tuple(body.color) for body in bodies]
    shown = sorted(set(plan.steps.tolist()))
    with tempfile.TemporaryDirectory() as folder, contour_shading(scene):
        rendered = {}
        for number, step in enumerate(shown, start=1):
            rendered[step] = Path(folder) / f"rendered_{step:06d}.png"
            colours = stress_colours(results.von_mises_pa[step, shards], scale)
            render_coloured(scene, int(results.frames[step]), bodies, colours, rendered[step])
            done(number, len(shown))
        pictures = []
        made: set[Path] = set()
        for step, speed in zip(plan.steps.tolist(), plan.speeds.tolist(), strict=True):
            picture = Path(folder) / f"picture_{step:06d}_{speed:g}.png"
            if picture not in made:
                lay_over(rendered[step], picture, scale, _words(float(results.times_s[step]), speed))
                made.add(picture)
            pictures.append(picture)
        render = scene.render
        encode_film(pictures, path, PICTURES_PER_SECOND, (render.resolution_x // 2 * 2, render.resolution_y // 2 * 2))
        for body, colour in zip(bodies, kept, strict=True):
            body.color = colour


def _words(time_s: float, speed: float) -> str:
    if speed == 1.0:
        return f"{time_s:.2f} s, real time"
    return f"{time_s:.2f} s, {1.0 / speed:g} times slower" if speed > 0.0 else f"{time_s:.2f} s"
