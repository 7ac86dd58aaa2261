/** Rules for the JavaScript of the page, of exports and of atlases; lines are as wide as Python's. */

import js from "@eslint/js";
import globals from "globals";

const TEXT = "^\\s*(//|\\*|/\\*\\*).*https?://";

export default [
  js.configs.recommended,
  {
    files: ["**/*.js"],
    linterOptions: { reportUnusedDisableDirectives: "error" },
    languageOptions: { ecmaVersion: 2024, sourceType: "module", globals: globals.browser },
    rules: {
      complexity: ["error", 15],
      "max-len": ["error", { code: 110, ignorePattern: TEXT }],
      "max-lines-per-function": ["error", { max: 60, skipBlankLines: true, skipComments: true }],
      "no-unused-vars": ["error", { ignoreRestSiblings: true }],
    },
  },
  {
    // Python joins the scripts of such a page within one function, so that each sees the names of all others.
    // The types' check, which reads them together, finds a name that none of them has.
    files: ["app/export/page/*.js", "app/atlas/page/*.js"],
    languageOptions: { sourceType: "script" },
    rules: {
      "no-redeclare": ["error", { builtinGlobals: false }],
      "no-undef": "off",
      "no-unused-vars": ["error", { vars: "local", ignoreRestSiblings: true }],
    },
  },
];
