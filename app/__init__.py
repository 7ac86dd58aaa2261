"""Everything with state, time, threads, browsers and cables; its own file starts the command line."""
