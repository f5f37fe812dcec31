# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks a document against the part of JSON Schema (draft-07) that frame.schema.json uses.

Known keywords: type, const, enum, properties, required, additionalProperties (false),
items (one schema), minItems, maxItems, minimum, maximum, exclusiveMinimum, pattern,
and $ref to `#/definitions/…`. Any other keyword in a schema is an error, so that nothing is
believed to be checked that is not.
"""

import math
import re

_TYPES = {"object": dict, "array": list, "string": str, "boolean": bool}
_WORDS = {"$schema", "$id", "title", "description", "definitions", "type", "const", "enum",
          "properties", "required", "additionalProperties", "items", "minItems", "maxItems",
          "minimum", "maximum", "exclusiveMinimum", "pattern", "$ref"}


def first_problem(value, schema):
    """One sentence about the first fault found, or None."""
    return next(_problems(value, schema, schema, "document"), None)


def _problems(value, schema, root, place):
    if "$ref" in schema:
        schema = root["definitions"][schema["$ref"].rpartition("/")[2]]
    unknown = set(schema) - _WORDS
    if unknown:
        raise ValueError(f"schema keyword not supported: {', '.join(sorted(unknown))}")
    if "type" in schema and not _is_type(value, schema["type"]):
        yield f"{place} is not of type {schema['type']}"
        return
    if "const" in schema and value != schema["const"]:
        yield f"{place} is not {schema['const']!r}"
    if "enum" in schema and value not in schema["enum"]:
        yield f"{place} is none of {', '.join(map(str, schema['enum']))}"
    if isinstance(value, dict):
        yield from _object_problems(value, schema, root, place)
    elif isinstance(value, list):
        yield from _array_problems(value, schema, root, place)
    elif isinstance(value, str):
        if "pattern" in schema and not re.search(schema["pattern"], value):
            yield f"{place} does not match {schema['pattern']}"
    elif not isinstance(value, bool) and value is not None:
        yield from _number_problems(value, schema, place)


def _is_type(value, name):
    if name == "integer":
        return isinstance(value, int) and not isinstance(value, bool)
    if name == "number":
        return isinstance(value, (int, float)) and not isinstance(value, bool)
    return isinstance(value, _TYPES[name])


def _object_problems(value, schema, root, place):
    properties = schema.get("properties", {})
    for name in schema.get("required", ()):
        if name not in value:
            yield f"{place} lacks '{name}'"
    for name, member in value.items():
        if name in properties:
            yield from _problems(member, properties[name], root, f"{place}.{name}")
        elif schema.get("additionalProperties", True) is False:
            yield f"{place} has the unknown property '{name}'"


def _array_problems(value, schema, root, place):
    if len(value) < schema.get("minItems", 0):
        yield f"{place} has {len(value)} items, fewer than {schema['minItems']}"
    if len(value) > schema.get("maxItems", len(value)):
        yield f"{place} has {len(value)} items, more than {schema['maxItems']}"
    for number, item in enumerate(value):
        yield from _problems(item, schema.get("items", {}), root, f"{place}[{number}]")


def _number_problems(value, schema, place):
    if not math.isfinite(value):
        yield f"{place} is not a finite number"
    if value < schema.get("minimum", value):
        yield f"{place} is below {schema['minimum']}"
    if value > schema.get("maximum", value):
        yield f"{place} is above {schema['maximum']}"
    if "exclusiveMinimum" in schema and value <= schema["exclusiveMinimum"]:
        yield f"{place} is not above {schema['exclusiveMinimum']}"
