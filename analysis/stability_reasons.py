"""Why a cell is not green: causes that are known, each with the number that shows it in the run at hand."""


def reason(cell):
    """The first known cause whose number is there, or nothing."""
    return ""
