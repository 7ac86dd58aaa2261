"""The mechanism: parameters, leg, ring of legs, coupled actuators."""
