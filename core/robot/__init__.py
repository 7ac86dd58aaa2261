"""The mechanism: parameters, kinematics of one leg and of all legs, coupled motors."""
