/** The parts of Node's test runner that the page's tests use; all of Node's types would replace some of the page's. */

declare module "node:test" {
  export function test(name: string, body: () => void | Promise<void>): void;
  export function beforeEach(run: () => void | Promise<void>): void;
}

declare module "node:assert/strict" {
  const assert: Record<"deepEqual" | "equal" | "notEqual" | "ok" | "rejects", (...given: any[]) => void>;
  export default assert;
}
