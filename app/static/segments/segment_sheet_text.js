/** A block of the segment table as text: tabs between the columns, as spreadsheets exchange it. CSV is read too. */

/** Rows of names as lines with tabs. */
export const textOf = (rows) => rows.map((row) => row.join("\t")).join("\n");

/** The fields of one line of CSV, also those in which nothing stands; a quoted field may hold the separator, and doubled quotes. */
function fieldsOf(line, separator) {
  const fields = [];
  const pattern = new RegExp(`${separator}[^\\S${separator}]*(?:"((?:[^"]|"")*)"|([^${separator}]*))`, "g");
  for (const [, quoted, plain] of `${separator}${line}`.matchAll(pattern)) fields.push((quoted === undefined ? plain : quoted.replaceAll('""', '"')).trim());
  return fields;
}

/** Rows of names from text with tabs, semicolons or commas between the columns; blank lines at the end are passed over. */
export function namesFrom(text) {
  const lines = text.replace(/[\r\n]+$/, "").split(/\r\n|\r|\n/);
  if (lines.join("").trim() === "") return { reason: "The clipboard is empty: copy segments first." };
  const separator = ["\t", ";", ","].find((one) => text.includes(one)) ?? "\t";
  return { names: lines.map((line) => fieldsOf(line, separator)) };
}
