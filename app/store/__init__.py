"""The data folder: gait files, journals of runs, and one SQLite file; not pictures and videos."""
