"""scripts/update_codemeta: codemeta.json is what it makes of CITATION.cff, which has the version of this tree."""
import importlib.machinery
import importlib.util
import json
import pathlib
import re
import sys
import unittest

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]


def load(path):
    loader = importlib.machinery.SourceFileLoader(path.name, str(path))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(path.name, loader))
    loader.exec_module(module)
    return module


sys.dont_write_bytecode = True  # beside the scripts
script = load(ROOT / "scripts/update_codemeta")
citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())


class UpdateCodemeta(unittest.TestCase):
    def test_the_committed_file_is_what_it_writes(self):
        self.assertEqual((ROOT / "codemeta.json").read_text(), script.text_of(ROOT / "CITATION.cff"))

    def test_names_people_and_groups_as_what_they_are(self):
        changed = {**citation, "authors": [{"given-names": "Ada", "family-names": "Byron"}, {"name": "a group"}]}
        person, group = script.codemeta(changed)["author"]
        self.assertEqual(person, {"type": "Person", "givenName": "Ada", "familyName": "Byron"})
        self.assertEqual(group["type"], "Organization")

    def test_the_version_is_that_of_the_tree(self):
        project = re.search(r"project\(voxtet VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]
        self.assertEqual(citation["version"], project)
        self.assertEqual(json.loads((ROOT / "web/package.json").read_text())["version"], project)

    def test_no_file_overrules_the_citation(self):
        self.assertFalse((ROOT / ".zenodo.json").exists())


if __name__ == "__main__":
    unittest.main()
