// SPDX-License-Identifier: BSD-3-Clause
// The guided scenes: three sentences and a question each, the answer one click away.
import datasets from "virtual:datasets";

export interface GuidedScene {
  id: string;
  title: string;
  toml: string;
  t?: number; // shown first
  timeShown?: number;
  tab: "bed" | "methods" | "collisions" | "fit";
  dataset?: string; // observations that belong to it
  sentences: [string, string, string];
  question: string;
  answer: string;
}

const of = (file: string): string => datasets[file]!;

export const GUIDED: readonly GuidedScene[] = [
  {
    id: "may", title: "May, Shearer & Daniels 2010", toml: of("may-2010-piecewise/scene.toml"), t: 0.5, tab: "bed",
    sentences: [
      "Large grains lie below small ones in a shear cell, which is sheared eight times as fast below z = 0.29 as above.",
      "Small grains fall through the gaps: at the jump a fan of waves opens, with the speed s a of pure grains at its edges, and in it the grains mix.",
      "Where an edge meets a wall the grains pile up and shocks start, which meet at t*: then the bed is segregated, the other way round.",
    ],
    question: "Drag the interface from z = 0.29 up towards the jump. Which event times change at once, and which do not?",
    answer: "t_c = (z0 - zc)/k1 and t_0 = t_c + zc/k0 shrink; t_1 = (1 - z0)/k1 and t* = 2/k1 stay, as the upper edge of the fan and the last shocks run in the slow layer alone.",
  },
  {
    id: "exponential", title: "An exponential shear rate", toml: of("may-2010-exponential/scene.toml"), tab: "bed",
    sentences: [
      "In a real shear cell the rate falls smoothly away from the moving wall: a(z) = A exp(-z/d).",
      "Characteristics then bend, and so do fronts: a wave that runs down gets faster, one that runs up slower.",
      "There is no interface and no t_c any more, but the fan, the shocks and t* are all there.",
    ],
    question: "Bend the curve of s a(z) with its middle handle until the rate is nearly constant. What becomes of the curved edges of the fan?",
    answer: "They straighten: in a constant a(z) the edges are straight lines of slopes -s a and s a, mirror images of each other.",
  },
  {
    id: "bottleneck", title: "A bottleneck under a mixture", toml: of("bottleneck/scene.toml"), tab: "bed",
    sentences: [
      "The same two layers, but the bed begins mixed: 65 % small grains everywhere.",
      "The fast layer could send up more large grains than the slow one can take.",
      "So a queue forms below the interface, as before a narrow place of a road: φ jumps there although nothing moves the jump.",
    ],
    question: "Raise the rate of the upper layer. At which rate does the jump at the interface vanish?",
    answer: "When both layers have the same rate: the flux s a f(φ) is continuous at an interface, φ is so only where a is.",
  },
  {
    id: "red-light", title: "A red light", toml: of("traffic-red-light/scene.toml"), t: 0.9, timeShown: 3, tab: "bed",
    sentences: [
      "The same equation for cars: φ is the density of traffic on a road, z the way along it, and the flux has a maximum.",
      "The light at the top is red until t = 1: cars stop, and a shock, the end of the queue, runs backwards.",
      "At green the queue dissolves in a fan, whose lower edge races to catch up with the end of the queue.",
    ],
    question: "Double the density that arrives (start, and beyond the bottom). Does the queue still dissolve before it fills the road?",
    answer: "Yes: with a density d the end of the queue runs back with speed d, and the fan catches it at z = (1 - 2d)/(1 - d): at 3/4 for d = 0.2, at 1/3 for d = 0.4, and just at the end of the road for d = 1/2.",
  },
  {
    id: "mixes-first", title: "It mixes before it segregates", toml: of("shear-cell-ideal/scene-inverse.toml"), tab: "bed",
    sentences: [
      "A cell with the same shear rate everywhere, small grains on top: the fan is symmetric, and both edges reach the walls at the same time.",
      "The strip below the plane shows Ψ(t), which is 0 where the grains are apart and 1 where they are evenly mixed.",
      "Until its edges reach the walls the fan only widens, so the bed can only mix; after that the shocks take away from it, and in the end everything is apart again.",
    ],
    question: "At which time is the bed best mixed, and why not at t_1 exactly?",
    answer: "Near 0.75, one and a half times t_1: the fan flattens on while the shocks grow. Ψ turns when the loss at the shocks outweighs it.",
  },
  {
    id: "cubic", title: "A cubic flux: compound waves", toml: of("segregation-gamma-0.9/scene.toml"), t: 3, tab: "collisions",
    sentences: [
      "Small grains fall faster through large ones than large ones rise through small ones: f gains a factor 1 - γ φ, and bends both ways.",
      "A fan can then end in a shock that moves with the speed of its last wave: a compound.",
      "Step through the collisions below: the chords lie on the envelope of the flux, not on the flux itself.",
    ],
    question: "Lower γ below 1/2 in the tab Bed. What happens to the shock above the fan, and why at 1/2?",
    answer: "It vanishes: for γ <= 1/2 the flux is convex on all of [0, 1], so its lower envelope is the flux itself and the fan is whole.",
  },
  {
    id: "five-layers", title: "Five layers", toml: of("paper-example-4/scene.toml"), tab: "methods",
    sentences: [
      "Five layers, each slower than the one below, as a staircase stands for a smooth rate.",
      "The exact formula still gives each point by itself; front tracking follows every front through every interface.",
      "Below, three methods do the same profile: watch what an error half as large costs each of them.",
    ],
    question: "How many cells does it take to be as accurate as front tracking with a step of 0.05, and how much longer does that last?",
    answer: "Some 600, and ten to twenty times as long: the error falls like 1/N at shocks while the work grows like N squared.",
  },
  {
    id: "particles", title: "A particle simulation and its misfit", toml: of("dem-shear-cell-piecewise/scene-5-layers.toml"), tab: "fit", dataset: "dem-shear-cell-piecewise/observations-early.csv",
    sentences: [
      "The dots are φ of a simulation with 4950 grains that obey Newton's laws, not our equation.",
      "Fit the five rates, and look at the residuals: they are several times the scatter of the data, and have structure.",
      "The warnings say so, and that the error bars are too small: the model has no diffusion, and grains near the walls behave otherwise.",
    ],
    question: "Fit, then read the warnings: which of the five rates would you believe, and what would you measure next?",
    answer: "Those of the middle layers, where the fan has passed in the time of the data. The intervals assume independent noise, which these residuals are not. The profile in the middle is smeared where the model has a sharp edge: look for diffusion, and measure early and near the jump.",
  },
];
