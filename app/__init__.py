"""What happens: state, time, threads, browsers and cables."""
