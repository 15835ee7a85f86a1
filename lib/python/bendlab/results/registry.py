"""The bending models and solver methods of the program, in the program's order, with traits (properties).

configs/schema.json lists the models and methods of this checkout, so that pages can be laid out before there
are runs. A run file or sweep file lists the models and methods of the program that wrote it. If this program
had more, the additional models and methods come last.
"""
import json
from pathlib import Path

SCHEMA = Path(__file__).resolve().parents[4] / "configs/schema.json"
_models, _methods = {}, {}  # name → traits, as far as they are known


def learn(models, methods):
    """Adds the models and methods that a file lists. Older files list no methods, and labels of models in
    place of traits."""
    for known, listed in ((_models, models), (_methods, methods)):
        for name, traits in listed.items():
            known.setdefault(name, {}).update(traits if isinstance(traits, dict) else {})


def models():
    """Names of all bending models."""
    return list(_models)


def methods():
    """Names of all solver methods."""
    return list(_methods)


def model_place(name):
    """The index of a model in the order of all models. A model that no file lists comes last."""
    return _place(_models, name)


def method_place(name):
    """The index of a solver method in the order of all methods."""
    return _place(_methods, name)


def _place(known, name):
    known.setdefault(name, {})
    return list(known).index(name)


def made_of(model):
    """What the model's constraints are: "nothing", "springs", "hinges", "elements"; "" if not known."""
    return _models.get(model, {}).get("made_of", "")


def is_prestressed(model):
    """Whether the model's springs push in the sheet at rest."""
    return _models.get(model, {}).get("prestressed", False)


def has_springs_at_rest(model):
    """Whether the model's constraints are springs that do not push in the sheet at rest. The moment of such
    springs is C κ³ (κ: curvature)."""
    return made_of(model) == "springs" and not is_prestressed(model)


def usual(method, setting):
    """The default of a setting of a method, if the setting has a list of choices; else None."""
    return _methods.get(method, {}).get(setting)


_schema = json.loads(SCHEMA.read_text(encoding="utf-8")) if SCHEMA.exists() else {}
learn(_schema.get("x-models", {}), _schema.get("x-methods", {}))
