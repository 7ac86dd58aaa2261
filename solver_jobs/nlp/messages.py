"""Messages about each family of constraints, and about IPOPT's return status."""

from solver_jobs.nlp.constraint import Family

FAMILY_WORDS = {
    Family.BOUNDARY: "start and goal",
    Family.DYNAMICS: "the equations of motion",
    Family.BODY_HEIGHT: "body height",
    Family.FOOT_HEIGHT: "foot height",
    Family.FOOT_SPEED: "foot speed",
    Family.BODY_SPEED: "body speed",
    Family.GROUNDED_VELOCITY: "standing still",
    Family.GROUNDED_HEIGHT: "the height of standing feet",
    Family.CONTACT_FORCE: "contact force",
    Family.FLOATING_FORCE: "force in the air",
    Family.BODY_TORQUE: "balance",
    Family.WORKSPACE: "reach",
    Family.CLEARANCE: "swing clearance",
    Family.MARGIN: "stability margin",
    Family.FRICTION: "friction",
    Family.MOTOR_SPEED: "motor speed",
    Family.MOTOR_ACCELERATION: "motor acceleration",
    Family.SHOE_DISTANCE: "room between shoes",
}
"""Names in sentences."""

_SHORTER = "Shorten the step or lengthen the phases."

REMEDIES = {
    Family.BOUNDARY: "Choose a start and a goal that keep the limits.",
    Family.DYNAMICS: _SHORTER,
    Family.BODY_HEIGHT: "Choose start and goal heights within the body's bounds.",
    Family.FOOT_HEIGHT: "Choose start and goal with no foot below the ground.",
    Family.FOOT_SPEED: _SHORTER,
    Family.BODY_SPEED: _SHORTER,
    Family.GROUNDED_VELOCITY: _SHORTER,
    Family.GROUNDED_HEIGHT: "Put standing feet on the ground.",
    Family.CONTACT_FORCE: "Keep more feet on the ground or change the foot order.",
    Family.FLOATING_FORCE: "Keep more feet on the ground.",
    Family.BODY_TORQUE: "Shorten the step, change the foot order, or keep three feet down.",
    Family.WORKSPACE: "Shorten the step, change the body's height, or use the other workspace.",
    Family.CLEARANCE: "Lower the clearance or lengthen the swing.",
    Family.MARGIN: "Lower the margin, shorten the step, or keep a final stance.",
    Family.FRICTION: "Lengthen the phases or use feet with more grip.",
    Family.MOTOR_SPEED: _SHORTER,
    Family.MOTOR_ACCELERATION: "Lengthen the phases, shorten the step, or lower the clearance.",
    Family.SHOE_DISTANCE: "Shorten the step, or move the footholds apart.",
}
"""What to do about each."""
