"""Units and meanings of settings and summary numbers, as the program states them."""
import json
import subprocess


class Meanings:
    """What `bendlab schema` and `bendlab measures` say. Without a program every unit and meaning is ""."""

    def __init__(self, program=None):
        self._schema = _asked(program, "schema") or {}
        self._numbers = {entry["name"]: entry for measure in _asked(program, "measures") or []
                         for entry in measure["run"]}

    def setting(self, pointer):
        """(unit, meaning) of a setting by its JSON pointer."""
        found = _in_schema(self._schema, pointer.split("/")[1:]) or {}
        return found.get("x-unit", ""), found.get("description", "")

    def number(self, name):
        """(unit, meaning) of a number of a run's summary."""
        found = self._numbers.get(name, {})
        return found.get("unit", ""), found.get("meaning", "")


def _asked(program, what):
    if not program:
        return None
    try:
        told = subprocess.run([program, what, "--json"], capture_output=True, check=True, timeout=30)
        return json.loads(told.stdout)
    except (OSError, ValueError, subprocess.SubprocessError):
        return None


def _in_schema(node, path):
    """The entry of a schema at a path of keys, None if there is none."""
    if not path:
        return node
    for choice in (node, *node.get("oneOf", []), *node.get("anyOf", [])):
        below = choice.get("properties", {}).get(path[0])
        if below is None and path[0].isdigit():
            below = choice.get("items")
        found = below and _in_schema(below, path[1:])
        if found:
            return found
    return None
