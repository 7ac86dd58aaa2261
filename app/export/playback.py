"""One HTML page with 3D playback and the gait diagram; it opens by double click, without any server."""

from html import escape

import numpy as np

from app.common.json import Json
from app.common.page_template import filled, script_json
from app.export.gait_diagram import PlotArea, facts, gait_diagram, plot_area, sample_edges
from app.export.source import Motion
from app.export.svg import svg
from core.arrays import Floats
from core.data.tables import package_files
from core.gait.gait import Gait
from core.motion.support_polygon import stability_margins
from core.robot.coupled_strokes import real_feet
from core.robot.leg import vertex_directions
from core.robot.model import RobotModel

_SCRIPTS = ("view.js", "robot.js", "scene.js", "player.js")


def playback_page(gait: Gait, motion: Motion) -> str:
    """The page.

    Args:
        gait: for the diagram.
        motion: what is played.
    """
    diagram = gait_diagram(gait, motion.model, is_headed=False)
    script = "\n".join(_part(name) for name in _SCRIPTS)
    parts = {
        "NAME": escape(gait.name),
        "FACTS": escape(facts(gait, sample_edges(gait, motion.model))),
        "NOTE": escape(motion.note),
        "STYLE": _part("page.css"),
        "DIAGRAM": svg(diagram),
        "DATA": script_json(_content(gait, motion)),
        "SCRIPT": f'(() => {{\n"use strict";\n{script}}})();',
    }
    return filled(_part("page.html"), parts)


def _part(name: str) -> str:
    return package_files("app.export").joinpath("page", name).read_text("utf-8")


def _content(gait: Gait, motion: Motion) -> Json:
    """What the page plays: SI, a row a knot."""
    t, area = motion.trajectory, plot_area(gait, motion.model, is_headed=False)
    return {
        "times": t.times.tolist(),
        "body": t.pose(motion.model).position_world.tolist(),
        "heading": t.heading.tolist(),
        "feet": real_feet(motion.model, t.feet_world, t.pose(motion.model)).tolist(),
        "contact": t.contact.tolist(),
        "strokes": motion.strokes.tolist(),
        "margins": stability_margins(t.body_world[:, :2], t.feet_world, t.contact).tolist(),
        "roles": list(gait.roles),
        "colours": list(motion.model.colours),
        "robot": _shape(motion.model),
        "diagram": {
            "left": area.left,
            "width": area.width,
            "top": area.top,
            "bottom": area.bottom,
            "places": _places(gait, motion, area).tolist(),
        },
    }


def _places(gait: Gait, motion: Motion, area: PlotArea) -> Floats:
    """(knots,) where each knot lies on the diagram, px; of evenly spaced ones in the middle of its sample."""
    times = motion.trajectory.times - motion.trajectory.times[0]
    if gait.poses is None:
        samples = gait.timeline.sample_count
        times = area.seconds * np.minimum((np.arange(len(times)) + 0.5) / samples, 1.0)
    return np.asarray(area.left + area.width * times / area.seconds)


def _shape(model: RobotModel) -> Json:
    """Sizes and places of the robot's parts in its own frame, m."""
    shape, R = model.shape, model.R_robot_from_module[:, :2, :2]
    directions = np.einsum("lij,kj->lki", R, vertex_directions())
    return {
        "centres": model.module_centres_robot[:, :2].tolist(),
        "directions": directions.tolist(),
        "base_radius": model.leg.base_radius,
        "platform_radius": model.leg.platform_radius,
        "com_height": model.com_height,
        "sole_depth": model.sole_depth,
        "plate_across": max(shape.plate_across, 2 * (model.radius + model.leg.base_radius)),
        "plate_heights": [shape.lower_plate_height, shape.upper_plate_height],
        "plate_thickness": shape.plate_thickness,
        "board_height": shape.board_height,
        "board": list(shape.board),
        "motor_width": shape.motor_width,
        "motor_length": shape.motor_length,
        "rod_diameter": shape.rod_diameter,
        "rod_spacing": shape.rod_spacing,
        "foot_diameter": shape.foot_diameter,
        "sole_diameter": shape.sole_diameter,
    }
