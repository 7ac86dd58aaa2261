/** The text of a file that a person chose. `File.text()` would read another encoding as � without a word. */

/**
 * @param {Blob & {name: string}} file
 * @returns {Promise<string>} with the mark of byte order, where there is one
 * @throws {Error} where the file is no text in UTF-8
 */
export async function textOf(file) {
  const bytes = new Uint8Array(await file.arrayBuffer());
  try {
    if (!bytes.includes(0)) return new TextDecoder("utf-8", { fatal: true, ignoreBOM: true }).decode(bytes);
  } catch {
    // Said below, as for a file with zero bytes.
  }
  throw new Error(`${file.name} is not text in UTF-8. Save it as UTF-8 (in Excel “CSV UTF-8”).`);
}
