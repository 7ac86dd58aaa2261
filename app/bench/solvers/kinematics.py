"""Walker poses a second."""

from functools import partial

import numpy as np

from app.bench.common.measure import Row, median_seconds
from core.robot.kinematics import BodyPose, walker_feet, walker_strokes
from core.robot.leg import foot_from_strokes
from core.robot.model import load_robot

POSES = 100_000


def bench_kinematics() -> list[Row]:
    """Walker poses a second, forward and inverse, for each robot."""
    rows: list[Row] = []
    for name in ("deltawalker", "hexapod", "dodecapod"):
        model = load_robot(name)
        random = np.random.default_rng(0)
        count = POSES * 4 // model.leg_count
        strokes = random.uniform(0.0005, 0.0195, (count, model.leg_count, 3))
        strokes = strokes[np.isfinite(foot_from_strokes(model.leg, strokes)).all(axis=(1, 2))]
        pose = BodyPose(np.zeros((len(strokes), 3)), np.zeros(len(strokes)))
        feet = walker_feet(model, strokes, pose)
        forward = median_seconds(partial(walker_feet, model, strokes, pose))
        inverse = median_seconds(partial(walker_strokes, model, feet, pose))
        rows.append(
            {
                "robot": name,
                "poses": len(strokes),
                "forward_per_second": round(len(strokes) / forward),
                "inverse_per_second": round(len(strokes) / inverse),
            }
        )
    return rows
