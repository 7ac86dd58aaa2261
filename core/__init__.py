"""What is true: pure mathematics and values of walking delta robots; numpy only."""
