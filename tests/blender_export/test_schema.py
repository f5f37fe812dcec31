# SPDX-License-Identifier: GPL-3.0-or-later
import json
import os
import unittest

from paths import REPOSITORY, exporter

schema_check = exporter("schema_check")
problem = schema_check.first_problem


class SchemaCheck(unittest.TestCase):
    def test_types(self):
        for kind, good, bad in (("integer", 3, 3.5), ("integer", 0, True), ("number", 2.5, "2.5"),
                                ("number", 1, False), ("string", "a", 1), ("boolean", True, 1),
                                ("array", [], {}), ("object", {}, [])):
            with self.subTest(kind):
                self.assertIsNone(problem(good, {"type": kind}))
                self.assertIn(kind, problem(bad, {"type": kind}))

    def test_each_keyword_finds_its_fault(self):
        row = {"definitions": {"row": {"type": "array", "minItems": 2}}, "$ref": "#/definitions/row"}
        for value, schema in ((2, {"const": 1}), ("c", {"enum": ["a", "b"]}),
                              ({}, {"required": ["x"]}), ([1], {"minItems": 2}),
                              ({"y": 1}, {"properties": {}, "additionalProperties": False}),
                              ([1, 2], {"maxItems": 1}), ([1, "a"], {"items": {"type": "number"}}),
                              (1, {"minimum": 2}), (3, {"maximum": 2}), (0, {"exclusiveMinimum": 0}),
                              ("xyz", {"pattern": "^[0-9]+$"}), (float("nan"), {"type": "number"}),
                              (float("inf"), {"type": "number"}), ([1], row),
                              ({"a": [{"b": 1}]}, {"properties": {"a": {"items": {
                                  "properties": {"b": {"type": "string"}}}}}})):
            with self.subTest(schema):
                self.assertIsNotNone(problem(value, schema))

    def test_the_place_of_a_fault_is_named(self):
        schema = {"properties": {"a": {"items": {"type": "string"}}}}
        self.assertEqual(problem({"a": ["x", 2]}, schema), "document.a[1] is not of type string")

    def test_a_keyword_that_is_not_checked_is_an_error(self):
        with self.assertRaises(ValueError):
            problem(1, {"multipleOf": 2})


class FrameSchema(unittest.TestCase):
    def setUp(self):
        with open(os.path.join(REPOSITORY, "blender_export", "frame.schema.json")) as file:
            self.schema = json.load(file)

    def test_every_property_is_described(self):
        def visit(node, place):
            for name, member in node.get("properties", {}).items():
                self.assertTrue(member.get("description"), f"{place}.{name}")
                visit(member, f"{place}.{name}")
            if "items" in node:
                visit(node["items"], place + "[]")
        visit(self.schema, "document")

    def test_every_keyword_is_one_that_is_checked(self):
        def visit(node):
            if "$ref" not in node:
                problem(None, {**node, "definitions": self.schema["definitions"]})
            for member in [*node.get("properties", {}).values(), *node.get("definitions", {}).values(),
                           *([node["items"]] if "items" in node else [])]:
                visit(member)
        visit(self.schema)


if __name__ == "__main__":
    unittest.main()
