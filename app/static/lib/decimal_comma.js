/** A decimal comma in a number field is read as a point; the browser would swallow it: 1,5 became 15. */

/** Whether the browser reads a comma in numbers by itself, as it does in some languages. */
const readsCommas = () => new Intl.NumberFormat().format(1.5).includes(",");

/** Lets every number field of the page take a comma, typed or pasted. */
export function mountDecimalComma() {
  if (readsCommas()) return;
  document.addEventListener("beforeinput", (event) => {
    const text = event.data ?? event.dataTransfer?.getData("text/plain");
    const { target, inputType } = event;
    const isNumber = target instanceof Element && target.matches("input[type=number]");
    if (!isNumber || !inputType.startsWith("insert") || !text?.includes(",")) return;
    event.preventDefault();
    document.execCommand("insertText", false, text.replaceAll(",", "."));
  });
}
