"""The 3D scenes: Viser servers on loopback, the robot's nodes in them, and the poses of plans."""

from app.scene.overlay import overlay_table, plan_poses
from app.scene.poses import PoseBlob, pose_frames
from app.scene.registry import Scenes

__all__ = ["PoseBlob", "Scenes", "overlay_table", "plan_poses", "pose_frames"]
