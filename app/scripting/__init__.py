"""What `import footfall` has for scripts and notebooks: functions, and values that show themselves."""
