/** The nearest number to `value` in the range from `low` to `high`. */
export const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
