//! A lesson of six steps, which the user follows on the picture that is shown.

/// The f-number of the narrow lens in the fifth step. The lens counts as that narrow a little before.
const NARROW: f64 = 15.9;
/// A lens with at most this f-number blurs clearly.
const WIDE: f64 = 4.0;
/// The focal plane has moved if its distance differs by more than this, relative to itself.
const MOVED: f32 = 0.02;

/// The place whose optics are drawn before anything was clicked.
const MIDDLE: [f32; 2] = [0.5; 2];

/// What the user is asked to do.
pub(super) struct Step {
    pub(super) title: &'static str,
    /// What to do, and what it shows.
    pub(super) text: &'static str,
    /// The controls to use, of which the first that is in view is pointed at.
    pub(super) controls: &'static [&'static str],
    /// Whether it was done since the step began.
    done: fn(now: &Seen, start: &Seen) -> bool,
}

/// What the steps ask for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Seen {
    /// The diameter of the lens, in scene units.
    pub(super) diameter: f32,
    pub(super) f_number: f64,
    /// In scene units.
    pub(super) focal_distance: f32,
    /// The samples per pixel that are asked for.
    pub(super) samples: u32,
    /// The place whose optics are drawn, as a fraction of the picture's size, if the drawing is open.
    pub(super) drawn: Option<[f32; 2]>,
}

pub(super) static STEPS: [Step; 6] = [
    Step {
        title: "A point lets in a sharp picture",
        text: "Drag Lens diameter all the way to the left. The lens is a point now: from each point of the scene, one ray reaches the film. So everything is sharp.",
        controls: &["Lens diameter"],
        done: |now, _| now.diameter == 0.0,
    },
    Step {
        title: "A wide lens blurs",
        text: "Drag Lens diameter to the right, to f/4 or wider. Each point of the lens sees the scene from another place, and the picture is the mean of what they see. They agree only in the focal plane.",
        controls: &["Lens diameter"],
        done: |now, _| now.f_number <= WIDE,
    },
    Step {
        title: "The focal plane",
        text: "Right-click something that is blurred. The focal plane moves there, and what was sharp before blurs: there is one distance at which the rays from all of the lens meet on the film.",
        controls: &["Focal plane distance"],
        done: |now, start| (now.focal_distance - start.focal_distance).abs() > MOVED * start.focal_distance,
    },
    Step {
        title: "The circle of confusion",
        text: "Press O, and click something that is blurred. The drawing shows that its light meets before the film or would meet behind it. The spot that it leaves on the film is its circle of confusion.",
        controls: &["Optics"],
        done: |now, start| now.drawn.is_some_and(|place| Some(place) != start.drawn && place != MIDDLE),
    },
    Step {
        title: "The f-number",
        text: "Open Lens and choose f/16. The f-number is the focal length divided by the diameter. A narrow lens makes all circles of confusion smaller, so a greater depth of field is sharp.",
        controls: &["f/16", "Lens"],
        done: |now, _| now.f_number >= NARROW,
    },
    Step {
        title: "More points, less noise",
        text: "Choose f/2 again, and drag Points per pixel to the right. Each point is a ray through another place of the pixel and of the lens. Four times as many halve the noise of their mean.",
        controls: &["Points per pixel"],
        done: |now, start| now.samples > start.samples,
    },
];

/// The lesson while it is followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Lesson {
    step: usize,
    start: Seen,
    /// Whether the step was done. It stays done, whatever the user does then.
    pub(super) done: bool,
}

impl Lesson {
    /// Begins with the first step.
    pub(super) fn new(now: Seen) -> Self {
        Self { step: 0, start: now, done: false }
    }

    pub(super) fn step(&self) -> &'static Step {
        &STEPS[self.step]
    }

    /// The number of the step, from 1.
    pub(super) fn number(&self) -> usize {
        self.step + 1
    }

    /// Notes whether the step is done now.
    pub(super) fn check(&mut self, now: &Seen) {
        self.done |= (self.step().done)(now, &self.start);
    }

    /// Goes on with the next step. `None` after the last one.
    pub(super) fn next(self, now: Seen) -> Option<Self> {
        let step = self.step + 1;
        (step < STEPS.len()).then(|| Self { step, ..Self::new(now) })
    }
}
