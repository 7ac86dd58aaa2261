"""The footfalls of a gait in a few letters, for the small picture in its line of the list."""

import numpy as np

from core.motion.contact_timeline import ContactTimeline

COLUMNS = 44
"""Width of the picture, px; a column of it is one bit."""


def footfall_columns(timeline: ContactTimeline) -> list[str]:
    """Stance of each foot, column by column, as hexadecimal digits: 4 columns a digit, 1 for stance.

    A column shows the sample at its middle. Where a column covers several samples, it shows a swing if the
    foot swings at any of them, so that no swing is lost.

    Args:
        timeline: legs × samples.

    Returns:
        A text of 11 digits for each foot.
    """
    samples = timeline.sample_count
    if samples > COLUMNS:
        columns = np.logical_and.reduceat(timeline.stance, np.arange(COLUMNS) * samples // COLUMNS, axis=1)
    else:
        columns = timeline.stance[:, ((np.arange(COLUMNS) + 0.5) * samples / COLUMNS).astype(int)]
    return [row.tobytes().hex()[: COLUMNS // 4] for row in np.packbits(columns, axis=1)]
