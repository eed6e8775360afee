// SPDX-License-Identifier: BSD-3-Clause
// A fit beside the page: the same engine in a thread of its own.
import { Engine } from "./engine.ts";
import type { FitNews, FitTask } from "./fit_messages.ts";

const tell = (news: FitNews): void => self.postMessage(news);
const MOST_NEWS = 40; // a second

self.onmessage = ({ data }: MessageEvent<FitTask>) => {
  try {
    const engine = new Engine(data.module);
    engine.setScene(data.scene);
    engine.setObservations(data.observations);
    const begin = performance.now();
    let last = 0;
    const estimate = engine.fit(data.fit, (evaluations, misfit, values) => {
      const now = performance.now();
      if (now - last > 1000 / MOST_NEWS || last === 0) {
        last = now;
        tell({ kind: "step", evaluations, misfit, values });
      }
      return true;
    });
    tell({ kind: "done", estimate, seconds: (performance.now() - begin) / 1000 });
  } catch (error) {
    tell({ kind: "refused", why: (error as Error).message });
  }
};
