"""Motions that leave the motors' range, such as the published ones do."""

from dataclasses import replace

import numpy as np

from app.export.import_gait import gait_of_recording
from core.gait.gait import Gait, motion_problem
from core.gait.recording import Recording, RecordingForm
from core.library.library import library
from core.motion.trajectory import Trajectory
from core.robot.model import load_robot
from core.wire.trajectory_csv import format_companion, format_trajectory_csv
from solver_jobs import solve_live

MODEL = load_robot("deltawalker")


def lowered(by: float) -> Trajectory:
    """The library's walk with its body lower by so many m, which asks for strokes below the motors' range."""
    motion = solve_live(motion_problem(library()["walk"].gait, MODEL)).trajectory
    down = np.array([0.0, 0.0, -by])
    return replace(motion, body_world=motion.body_world + down, contact_forces=None)


def recorded_gait(by: float) -> Gait:
    """The same motion as a recorded gait."""
    motion = lowered(by)
    text = format_trajectory_csv(motion)
    recording = Recording("walk.csv", RecordingForm.TRAJECTORY, text, format_companion(motion, text))
    return gait_of_recording(recording, "Walk").gait
