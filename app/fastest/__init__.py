"""The fastest gaits for the robot's clock: searched over foot orders, and the price of every option."""
