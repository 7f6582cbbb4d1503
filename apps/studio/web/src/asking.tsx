// Questions to the person, in a dialog.
import { useLayoutEffect, useRef } from "preact/hooks";
import { Asking, set, useStore } from "./store";

// Shows a dialog. Returns the chosen button and the name; nothing if the dialog was closed in another way.
export function ask(question: Omit<Asking, "answer">): Promise<{ button: string; name: string } | undefined> {
  return new Promise((resolve) =>
    set({
      asking: {
        ...question,
        answer: (button, name) => {
          set({ asking: undefined });
          resolve(button ? { button, name: name.trim() } : undefined);
        },
      },
    }),
  );
}

export function AskingDialog() {
  const { asking } = useStore();
  const dialog = useRef<HTMLDialogElement>(null);
  useLayoutEffect(() => {
    if (asking) dialog.current!.showModal();
    else dialog.current!.close();
    const field = dialog.current!.querySelector("input");
    if (!field) return;
    field.value = asking!.name!; // not a property of the element, which would undo what is typed when the page has news
    // The name is chosen without its ending, which mostly stays.
    field.setSelectionRange(field.value.lastIndexOf("/") + 1, field.value.replace(/(\.nii)?\.[^./]*$/, "").length);
  }, [asking]);
  const answer = (event: SubmitEvent) => {
    event.preventDefault();
    const form = event.currentTarget as HTMLFormElement;
    asking?.answer((event.submitter as HTMLButtonElement)?.value ?? asking.buttons[0], String(new FormData(form).get("name") ?? ""));
  };
  return (
    // Escape cancels. The event "close" comes later, when the next question may be there already.
    <dialog ref={dialog} class="asking" aria-labelledby="asking-title" onCancel={(event) => (event.preventDefault(), asking?.answer("", ""))}>
      {asking && (
        <form onSubmit={answer}>
          <h2 id="asking-title">{asking.title}</h2>
          {asking.text && <p>{asking.text}</p>}
          {asking.name !== undefined && <input name="name" type="text" aria-label="Name" required />}
          <p class="controls">
            {asking.buttons.map((button, n) => <button class={n === 0 ? "main" : ""} value={button}>{button}</button>)}
            <button type="button" onClick={() => asking.answer("", "")}>Cancel</button>
          </p>
        </form>
      )}
    </dialog>
  );
}
