"""The parts of a bending law that fabrics add to one rigidity, as text."""

ONE = "one rigidity"
PARTS = {"rigidity": "direction", "softening": "softening", "hysteresis": "friction",
         "plasticity": "folds that stay", "over_time": "over time", "map": "map"}  # in /bending


def law_of(config):
    """The law of a resolved config."""
    return " + ".join(text for part, text in PARTS.items() if config["bending"].get(part)) or ONE
