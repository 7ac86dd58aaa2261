"""The one message of a 3D client that Viser gets."""

from __future__ import annotations

from typing import Any

CAMERA: dict[str, Any] = {
    "type": "ViewerCameraMessage",
    "wxyz": [1, 0, 0, 0],
    "position": [0.1, 0.2, 0.3],
    "fov": 0.7,
    "near": 0.01,
    "far": 20,
    "image_height": 480,
    "image_width": 640,
    "look_at": [0, 0, 0],
    "up_direction": [0, 0, 1],
}
"""As the installed client sends it; numbers that are whole come as integers."""
