"""The gait document's form: pydantic models, from which the published JSON Schema is made. All numbers SI."""

from typing import Annotated, Any, Literal, TypeVar

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field
from pydantic_core import PydanticCustomError

from core.gait.gait import Orientation
from core.gait.options import OPTION_BOUNDS, GaitOptions
from core.gait.poses import MOST_PINNED, MOST_SWAY, POSE_LIMITS, Poses
from core.gait.recording import (
    LEAST_SCALE,
    MOST_RAISED,
    MOST_SCALE,
    RecordingFit,
    RecordingForm,
    WithinStroke,
)
from core.motion.heading_profile import HeadingProfile
from core.problem.motion_problem import Boundary, Cost, Workspace

SCHEMA_DIALECT = "https://json-schema.org/draft/2020-12/schema"


def _field(description: str, **words: Any) -> Any:
    return Field(description=description, **words)


def _option(name: str, description: str) -> Any:
    """An option with its default and its bounds, which `GaitOptions` holds documents to."""
    bounds = OPTION_BOUNDS.get(name)
    limits: dict[str, Any] = {} if bounds is None else {"minimum": bounds.least_si, "maximum": bounds.most_si}
    return Field(description=description, default=getattr(GaitOptions, name), json_schema_extra=limits)


def _pose_limit(name: str, description: str) -> Any:
    """A limit that only gaits with poses have, with its default and its bounds."""
    least, most = POSE_LIMITS[name]
    limits: dict[str, Any] = {"minimum": least, "maximum": most}
    return Field(description=description, default=getattr(Poses, name), json_schema_extra=limits)


def _title(name: str, info: object) -> str:
    del info
    return name.replace("_", " ").capitalize()


class _Model(BaseModel):
    model_config = ConfigDict(extra="forbid", allow_inf_nan=False, field_title_generator=_title)


def _without_quotes(value: Any) -> Any:
    if isinstance(value, str | bool):
        raise PydanticCustomError("whole_number", "Input should be a whole number without quotes")
    return value


Number = Annotated[float, Field(strict=True)]
"""A JSON number; a text that reads as one is none."""
Whole = Annotated[int, BeforeValidator(_without_quotes)]
"""A whole JSON number, such as 3 or 3.0."""
Metres = Annotated[Number, Field(description="m")]
Radians = Annotated[Number, Field(description="rad")]


MOST_ITEMS = 4000
"""No list or row of a document is longer; a guard, for each has its own bound below that."""
Item = TypeVar("Item")
Items = Annotated[list[Item], Field(max_length=MOST_ITEMS)]
Named = Annotated[dict[str, Item], Field(max_length=MOST_ITEMS)]
Row = Annotated[str, Field(max_length=MOST_ITEMS)]


class TimelineModel(_Model):
    """Contact of each foot: a string of 1 (stance) and 0 (swing), foot 1 first; `locked` likewise."""

    sample_time: Number = _field("time between samples, s")
    feet: Items[Row] = _field("a string a foot, a character a sample: 1 stance, 0 swing", min_length=1)
    locked: Items[Row] | None = _field("likewise: 1 where the cell is locked; null: none is", default=None)


class SegmentModel(_Model):
    """A segment between two named positions such as `Home-Base`."""

    start: str = _field("position at its first sample, xy name and z name joined by a hyphen")
    end: str = _field("position at its last sample")
    swing: bool = _field("whether the foot is in the air")


class VocabularyModel(_Model):
    """What the names of a segment table mean."""

    xy: Named[Number] = _field("multiple of the step's displacement, by name")
    z: Named[Number] = _field("motor stroke of a centred foot, m, by name")
    segments: Named[SegmentModel] = _field("segments by name")


class SegmentTableModel(_Model):
    """A row of segment names a foot, one iteration at direction 1."""

    samples_per_segment: Whole = _field("samples of a segment, both its ends included")
    repeat_from: Whole = _field("segment, counted from 1, with which the repeating part begins", default=1)
    repeat_to: Whole | None = _field("its last segment; null: the last of the table", default=None)
    link: Items[Items[str]] = _field("segments between two iterations, a row a foot", default_factory=list)
    feet: Items[Items[str]] = _field("segment names, a row a foot", min_length=1)
    definitions: VocabularyModel = _field("what the names mean")


class HeldModel(_Model):
    """Feet that are in the air on purpose at the ends of a gait, counted from 1."""

    start: Items[Whole] = _field("feet held up at the first sample", default_factory=list)
    end: Items[Whole] = _field("feet held up at the last sample", default_factory=list)


class OptionsModel(_Model):
    """What the optimiser is asked, and how its answer is sent."""

    clearance: Number = _option("clearance", "how high each swing rises at least, m")
    margin: Number = _option("margin", "how far the centre of pressure stays inside the support polygon, m")
    body_speed: Number = _option("body_speed", "limit of the body's speed, m/s")
    foot_speed: Number = _option("foot_speed", "limit of each foot's speed, m/s")
    plane_height: Number = _option("plane_height", "actuator plane at the start, m")
    workspace: Workspace = _option("workspace", "which form of reach holds")
    cost: Cost = _option("cost", "what is minimised")
    phase_knots: Whole = _option(
        "phase_knots", "samples of each stance phase and of each swing of a drawn timeline"
    )
    closing_knots: Whole = _option("closing_knots", "samples after the last swing of a drawn timeline")
    end_plane_height: Number | None = _option(
        "end_plane_height", "actuator plane at the goal, m; null: as at the start"
    )
    friction: Number | None = _option("friction", "coefficient of the friction cones, no unit; null: none")
    motor_speed: Number | None = _option("motor_speed", "limit of each motor's speed, m/s; null: none")
    motor_acceleration: Number | None = _option(
        "motor_acceleration", "limit of each motor's acceleration, m/s²; null: none"
    )
    boundary: Boundary = _option("boundary", "from rest to rest, or a cycle")
    turning: HeadingProfile = _option("turning", "when a gait with yaw turns the body")
    merge: Number = _option(
        "merge",
        "waypoints are left out within this distance of the motors' path, m; 0: every sample is sent",
    )
    stop_bound: Number | None = _option(
        "stop_bound",
        "longest time before the robot hears Stop, s; moves are cut for it; null: as long as a move takes",
    )


_RAISED_BOUNDS: dict[str, Any] = {"minimum": -MOST_RAISED, "maximum": MOST_RAISED}


class RecordingFitModel(_Model):
    """How a recorded motion is changed to fit the robot; its text stays as it is."""

    body: Metres = _field(
        "added to the body's heights, m", default=RecordingFit.body, json_schema_extra=_RAISED_BOUNDS
    )
    feet: Metres = _field(
        "added to the heights of the feet, m", default=RecordingFit.feet, json_schema_extra=_RAISED_BOUNDS
    )
    scale: Number = _field(
        "factor of the ways of body and feet from the first sample on, no unit",
        default=RecordingFit.scale,
        json_schema_extra={"minimum": LEAST_SCALE, "maximum": MOST_SCALE},
    )
    within_stroke: WithinStroke | None = _field(
        "clip: strokes beyond the motors' range go to its end; null: such a motion is refused",
        default=RecordingFit.within_stroke,
    )


class RecordingModel(_Model):
    """The motion of a file, which is then the gait's motion."""

    file: str = _field("name of the file")
    form: RecordingForm = _field("a trajectory CSV, or a waypoint CSV")
    text: str = _field("the file's text, to the last character")
    companion: str | None = _field("text of a trajectory's companion; null: it had none", default=None)
    sha256: str = _field("SHA-256 of `text` in UTF-8, hexadecimal")
    assumed: Items[str] = _field("what reading the file assumed, a sentence each", default_factory=list)
    fit: RecordingFitModel = _field(
        "how the motion is changed to fit the robot. Left out where it is as recorded",
        default_factory=RecordingFitModel,
    )


_PINNED_BOUNDS: dict[str, Any] = {"minimum": -MOST_PINNED, "maximum": MOST_PINNED}


class FoundPosesModel(_Model):
    """Poses as a solver has found them; the motors go straight from one to the next."""

    answers: str = _field("SHA-256 of what was asked; poses for anything else are solved again")
    step: Number = _field("travel of the body a cycle, m")
    bodies: Items[tuple[Metres, Metres, Metres]] = _field(
        "point of the body axis in the actuator plane at each pose, m; z above the standing feet's platforms"
    )
    feet: Items[Items[tuple[Metres, Metres, Metres]]] = _field("platform centre of each foot at each pose, m")
    headings: Items[Number] | None = _field(
        "turn of the body at each pose, rad. Left out where it is 0 throughout", default=None
    )


class PinnedPoseModel(_Model):
    """A pose whose body position is fixed, as an offset from where an even travel has the body."""

    pose: Whole = _field(
        "its number, counted from 1; neither the first nor the last", json_schema_extra={"minimum": 2}
    )
    along: Metres = _field("in the direction of travel, m", json_schema_extra=_PINNED_BOUNDS)
    sideways: Metres = _field("to the left of it, m", json_schema_extra=_PINNED_BOUNDS)


class PosesModel(_Model):
    """What a gait for the robot's clock asks beside options, order, step and iterations."""

    free_step: bool = _field(
        "whether the step, or on the spot the turn, is that of the fastest gait", default=Poses.free_step
    )
    slip: Number = _pose_limit("slip", "how far a standing foot may be off its foothold within a move, m")
    shoe_distance: Number = _pose_limit("shoe_distance", "least distance between the middles of two feet, m")
    arm_distance: Number = _pose_limit(
        "arm_distance", "least room between the arms of neighbouring legs, m; 0: they may touch"
    )
    sway: Number = _field(
        "how far the heading may leave an even turn, rad. Left out where it is 0",
        default=Poses.sway,
        json_schema_extra={"minimum": 0.0, "maximum": MOST_SWAY},
    )
    overlap: bool = _field(
        "whether a foot is lifted in the move that lowers the one before it. Left out where it is not",
        default=Poses.overlap,
    )
    found: FoundPosesModel | None = _field("the poses; null: none were found yet", default=None)
    pinned: Items[PinnedPoseModel] = _field(
        "where the body is to be at some poses. Left out where none is pinned", default_factory=list
    )


class ProvenanceModel(_Model):
    """Where the last computed result came from; it is of this document while `motion` matches it."""

    motion: str = _field("SHA-256 of everything in the document that the result was asked for by")
    trajectory: str = _field("SHA-256 of the result")
    method: str = _field("how it was computed, such as nlp")
    solver: str = _field("the solver's name and version")
    status: str = _field("what the independent checker made of it")
    seconds: Number = _field("time in the solver, s")
    made: str = _field("when, ISO 8601 with its offset from UTC")
    program: str = _field("version of the program")


class SingleGaitModel(_Model):
    """A gait of its own, as it stands in a file or in a part of a sequence."""

    format: Literal["footfall-gait"] = _field("what kind of document this is")
    version: Literal[1] = _field("version of this form")
    name: str = _field("what a person calls it")
    robot: str = _field("name of the robot's parameters file", default="deltawalker")
    orientation: Orientation = _field("FB moves along the diagonals, FBS along the axes (thesis 3.2)")
    direction: Whole = _field("1 to 4 (thesis Table 3.1)", default=1)
    order: Items[Whole] = _field("feet in the order of their steps at direction 1, counted from 1")
    step: tuple[Metres, Metres, Radians] = _field(
        "dx, dy in m and yaw in rad of the body an iteration, at direction 1"
    )
    iterations: Whole = _field("how often every foot steps", default=1)
    timeline: TimelineModel = _field(
        "contact of the robot's own feet, every iteration and the closing stance"
    )
    segment_table: SegmentTableModel | None = _field(
        "of a gait made by hand, in which case it says the motion; else null", default=None
    )
    options: OptionsModel = _field("what the optimiser is asked", default_factory=OptionsModel)
    notes: str = _field("a person's words", default="")
    recorded: RecordingModel | None = _field(
        "the motion of a file, in which case it is the gait's motion; else null", default=None
    )
    provenance: ProvenanceModel | None = _field(
        "of the last computed result, for whichever version of the gait; null: there is none", default=None
    )
    held: HeldModel = _field(
        "feet that rest in the air at an end, under their module, as high as swings rise and at least 3 mm; "
        "every other foot stands there. Left out where none is",
        default_factory=HeldModel,
    )
    poses: PosesModel | None = _field(
        "of a gait for the robot's clock, whose samples are poses; left out for every other gait",
        default=None,
    )


class SequencePartModel(_Model):
    """A gait within a sequence."""

    gait: SingleGaitModel = _field("the gait, whole")
    times: Whole = _field("how often it runs, 1 to 20", default=1)
    source: str | None = _field("id of the gait that it was copied from; null: not known", default=None)
    restarts: bool = _field(
        "true: each repetition is the whole gait with its own motion, from rest to rest. Left out: its "
        "iterations follow each other without a pause where they can",
        default=False,
    )


class GaitDocument(SingleGaitModel):
    """A gait as it stands in a file."""

    model_config = ConfigDict(json_schema_extra={"$schema": SCHEMA_DIALECT})

    sequence: Items[SequencePartModel] = _field(
        "gaits that follow each other; then robot, direction, order, step, iterations and timeline follow "
        "from them. Left out for a gait of its own",
        default_factory=list,
    )
