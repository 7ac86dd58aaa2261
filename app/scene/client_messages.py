"""The messages of a 3D client that Viser gets: where its camera is, and nothing else.

Viser trusts its clients: a message of another shape ends its handler with a traceback. The scene has nothing
that a client could click, drag or fill in, so every other kind of message is dropped.
"""

import msgspec

from core.errors import InputError

Numbers3 = tuple[float, float, float]

CAMERA = "ViewerCameraMessage"

REFUSAL = "The page sent a message that the 3D scene cannot read. Reload the page."


class Kind(msgspec.Struct):
    """A message of any kind."""

    type: str


class Camera(msgspec.Struct, tag_field="type", tag=CAMERA, forbid_unknown_fields=True):
    """Where a client's camera is; the fields are Viser's."""

    wxyz: tuple[float, float, float, float]
    position: Numbers3
    fov: float
    near: float
    far: float
    image_height: int
    image_width: int
    look_at: Numbers3
    up_direction: Numbers3


def is_camera(data: bytes | str) -> bool:
    """Whether a client's message is where its camera is.

    Args:
        data: the message, MessagePack.

    Raises:
        InputError: it is no message of a client, or a camera with other fields.
    """
    if isinstance(data, str):
        raise InputError(REFUSAL, "message")
    try:
        if msgspec.msgpack.decode(data, type=Kind).type != CAMERA:
            return False
        msgspec.msgpack.decode(data, type=Camera)
    except (ValueError, RecursionError) as error:
        raise InputError(REFUSAL, "message") from error
    return True
