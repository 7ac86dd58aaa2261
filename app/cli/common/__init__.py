"""What all commands use: printing results, and converting their arguments."""
