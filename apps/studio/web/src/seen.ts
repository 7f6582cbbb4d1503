// Work for what comes into view.
import { Inputs, useEffect, useRef } from "preact/hooks";

// Returns a reference to an element. When it is first seen, and again after `inputs` have changed, `act` is called;
// what it returns is called when they change, or the element goes.
export function useWhenSeen<T extends Element>(act: () => void | (() => void), inputs: Inputs) {
  const place = useRef<T>(null);
  useEffect(() => {
    let undo: void | (() => void);
    const observer = new IntersectionObserver(([entry]) => {
      if (!entry.isIntersecting) return;
      observer.disconnect();
      undo = act();
    });
    observer.observe(place.current!);
    return () => {
      observer.disconnect();
      undo?.();
    };
  }, inputs);
  return place;
}
