"""Draw the picture of the README and the welcome page: `python tools/picture.py` writes it."""

from pathlib import Path

import matplotlib.pyplot as plt

import rlnav as rl

FILE = Path(__file__).parents[1] / "book" / "_static" / "first-look.svg"


def draw() -> str:
    """Return the picture as SVG: the values of task 2 and the best path, on a light card."""
    with plt.rc_context():
        rl.plot.style()
        figure, ax = plt.subplots(figsize=(6, 5.2))
        task = rl.Task(rl.GridWorld.from_ascii(rl.maps.OBSTACLES))
        mdp = task.mdp()
        best = rl.value_iteration(mdp)
        rl.plot.values(task, best.V, ax=ax)
        rl.plot.path(task, rl.rollout(mdp, best.pi, start=task.index(rl.Pose(1, 1, 0)), rng=0), ax=ax)
        figure.set_facecolor("#ffffff")
        picture = rl.plot.to_svg(figure)
        plt.close(figure)
    return picture


if __name__ == "__main__":
    FILE.write_text(draw(), encoding="utf-8")
    print(f"{FILE.name}: {FILE.stat().st_size / 1e3:.0f} kB")
