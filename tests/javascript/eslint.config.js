/** Rules for the JavaScript of the page, of exports and of atlases; lines are as wide as those of the Python code. */

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
];
