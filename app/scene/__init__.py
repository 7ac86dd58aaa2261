"""The 3D scene: a Viser server on loopback, the robot's nodes, and the poses of plans."""

from app.scene.overlay import overlay_table, plan_poses
from app.scene.poses import PoseBlob, pose_frames
from app.scene.server import SceneServer

__all__ = ["PoseBlob", "SceneServer", "overlay_table", "plan_poses", "pose_frames"]
