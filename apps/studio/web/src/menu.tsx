// A button that opens a list of actions.
import { ComponentChildren } from "preact";
import { useLayoutEffect, useRef } from "preact/hooks";

export function Menu({ title, children }: { title: string; children: ComponentChildren }) {
  const menu = useRef<HTMLDetailsElement>(null);
  useLayoutEffect(() => {
    const close = (event: Event) => {
      const isInside = menu.current!.contains(event.target as Node);
      if (!isInside) menu.current!.open = false;
    };
    addEventListener("pointerdown", close);
    addEventListener("focusin", close);
    return () => {
      removeEventListener("pointerdown", close);
      removeEventListener("focusin", close);
    };
  }, []);
  const onKeyDown = (event: KeyboardEvent) => {
    if (event.key !== "Escape") return;
    menu.current!.open = false;
    menu.current!.querySelector("summary")!.focus();
  };
  return (
    <details class="menu" ref={menu} onKeyDown={onKeyDown}>
      <summary>{title}</summary>
      <div class="actions" onClick={(e) => (e.target as Element).closest("button") && (menu.current!.open = false)}>{children}</div>
    </details>
  );
}
