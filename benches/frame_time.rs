//! What a frame costs the window's own thread: laying out the whole window on a session that is
//! identified, and tessellating it, without anything that draws. Beside it the arrows alone as
//! `egui_plot` has them.
//!
//! The row "drag" is a region boundary under the hand on the largest session, while identifications
//! follow in the background as they do in the window; beside it what counting the samples of the
//! regions one by one takes, which a frame must not do.
//!
//! The rows "charts" are the same window with 1, 2 and 4 charts beside the workspace.
//!
//! The rows "in 3-D" are the same window with the workspace in three dimensions, where each frame looks
//! for the nearest of the samples that are drawn.
//!
//! The pointer is on the plot and moves, so that the nearest sample is searched in every frame. With
//! 10⁶ samples `egui_plot`'s arrows could not even be drawn: their index buffer is too long.

use std::fmt::Write as _;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, criterion_group, criterion_main};
use egui::{Context, Event, Key, Modifiers, PointerButton, Pos2, RawInput, Rect, pos2, vec2};
use egui_plot::{Arrows, Plot, PlotPoints};
use truepose::gui::{App, Runner};
use truepose::inside::Assignment;
use truepose::sessions::Region;

const SIZES: [usize; 3] = [1_000, 100_000, 1_000_000];

const HEAD: &str = r#"{ "format": "truepose-session/1", "name": "bench", "robot": { "name": "axis",
 "joints": [ { "name": "pan", "kind": "revolute", "axis": [0,0,1], "point_mm": [0,0,0] } ],
 "tool": { "position_mm": [250,0,300], "quaternion_wxyz": [1,0,0,0] } }, "tolerance_mm": 0.5,
 "instrument": { "name": "tracker", "sigma_mm": 0.03 }, "samples": { "file": "samples.csv" } }"#;

/// A column that turns, reflectors on it at one radius, a quarter of a millimetre off.
fn write_session(folder: &Path, samples: usize) -> PathBuf {
    let mut csv = "q1_deg,x_mm,y_mm,z_mm,dir1,load_kg,time_s\n".to_owned();
    for i in 0..samples {
        let t = i as f64;
        let q = (t * 0.618_033_988_75).fract() * 360.0 - 180.0;
        let (sin, cos) = (q + 0.05).to_radians().sin_cos();
        let noise = |step: f64| 0.03 * (t * step).sin();
        let direction = if i.is_multiple_of(2) { 1 } else { -1 };
        writeln!(
            csv,
            "{q:.5},{:.5},{:.5},{:.5},{direction},{},{}",
            250.2 * cos + noise(0.7),
            250.2 * sin + noise(1.3),
            300.1 + noise(1.9),
            3 * (i % 3),
            6 * i
        )
        .expect("memory suffices");
    }
    std::fs::write(folder.join("samples.csv"), csv).expect("the folder can be written to");
    let path = folder.join("session.json");
    std::fs::write(&path, HEAD).expect("the folder can be written to");
    path
}

struct Window {
    ctx: Context,
    app: App,
    frames: u32,
    /// The status bar of the last frame without an event.
    says: String,
    /// Where the handle of the boundary at 0° was in the last frame.
    handle: Option<Pos2>,
}

impl Window {
    /// A window on a session that is identified, with the table of samples beside it.
    fn new(samples: usize) -> Self {
        let folder = tempfile::tempdir().expect("there is a folder for temporary files");
        let path = write_session(folder.path(), samples);
        let mut window = Self::opening(path, Runner::AtOnce);
        for _ in 0..4 {
            window.frame(Vec::new());
        }
        window.frame(vec![key(Key::I)]);
        for _ in 0..4 {
            window.frame(Vec::new());
        }
        assert!(
            window.shows(samples) && window.says.contains('→'),
            "not identified: {}",
            window.says
        );
        window
    }

    /// Whether the status bar speaks of so many samples. It groups their digits.
    fn shows(&self, samples: usize) -> bool {
        let plain = self.says.replace('\u{202F}', "");
        plain.contains(&format!("{samples} samples · RMS error"))
    }

    fn opening(path: PathBuf, runner: Runner) -> Self {
        let ctx = Context::default();
        let app = App::new(&ctx, Some(path), runner);
        Self {
            ctx,
            app,
            frames: 0,
            says: String::new(),
            handle: None,
        }
    }

    /// A window in which the hand holds the boundary at 0°; tasks run on threads.
    fn dragging(samples: usize) -> Self {
        let folder = tempfile::tempdir().expect("there is a folder for temporary files");
        let path = write_session(folder.path(), samples);
        let mut window = Self::opening(path, Runner::Threads);
        // The handle is found where a screen reader finds it.
        window.ctx.enable_accesskit();
        window.wait("the session", |window| window.shows(samples));
        window.frame(vec![key(Key::Num2)]);
        window.wait("a boundary", |window| window.handle.is_some());
        // What the plots stand on is made in the background.
        std::thread::sleep(Duration::from_secs(5));
        let at = window.handle.expect("it was waited for");
        window.frame(vec![Event::PointerMoved(at)]);
        window.frame(vec![Event::PointerButton {
            pos: at,
            button: PointerButton::Primary,
            pressed: true,
            modifiers: Modifiers::NONE,
        }]);
        window
    }

    fn wait(&mut self, what: &str, there: impl Fn(&Self) -> bool) {
        for _ in 0..3000 {
            self.frame(Vec::new());
            if there(self) {
                return;
            }
            std::thread::sleep(Duration::from_millis(20));
        }
        panic!("{what} did not come: {}", self.says);
    }

    /// A frame in which the hand has moved on.
    fn dragged(&mut self) -> usize {
        let at = self.handle.expect("the hand is on it");
        let k = f32::from(u16::try_from(self.frames % 80).unwrap_or(0));
        let up = if k < 40.0 { k - 20.0 } else { 60.0 - k };
        self.frame(vec![Event::PointerMoved(pos2(at.x, at.y - 2.0 * up))])
    }

    /// One frame; the number of its triangles.
    fn frame(&mut self, events: Vec<Event>) -> usize {
        self.frames += 1;
        let still = events.is_empty();
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(pos2(0.0, 0.0), vec2(1280.0, 800.0))),
            time: Some(f64::from(self.frames) / 60.0),
            events,
            ..RawInput::default()
        };
        let app = &mut self.app;
        let mut output = self.ctx.run_ui(input, |ui| app.show(ui));
        output.textures_delta.clear();
        if still {
            let update = output.platform_output.accesskit_update.as_ref();
            let mut nodes = update.into_iter().flat_map(|update| &update.nodes);
            let handle = nodes.find(|(_, node)| node.label() == Some("boundary at 0°"));
            let bounds = handle.and_then(|(_, node)| node.bounds());
            self.handle = bounds.map(|b| {
                let middle = [f64::midpoint(b.x0, b.x1), f64::midpoint(b.y0, b.y1)];
                let [x, y] = middle.map(points);
                pos2(x, y)
            });
            let texts = output.shapes.iter().filter_map(|shape| match &shape.shape {
                egui::Shape::Text(text) => Some(text.galley.text()),
                _ => None,
            });
            let mut bars = texts.filter(|text| text.contains("· RMS error"));
            bars.next().unwrap_or_default().clone_into(&mut self.says);
        }
        triangles(&self.ctx, output)
    }

    /// A frame in which the pointer has moved on over the plot.
    fn moved(&mut self) -> usize {
        let k = f32::from(u16::try_from(self.frames % 60).unwrap_or(0));
        self.frame(vec![Event::PointerMoved(pos2(420.0 + 5.0 * k, 330.0))])
    }
}

#[allow(clippy::cast_possible_truncation, reason = "a place on the screen")]
fn points(place: f64) -> f32 {
    place as f32
}

fn key(key: Key) -> Event {
    Event::Key {
        key,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers: Modifiers::COMMAND,
    }
}

fn triangles(ctx: &Context, output: egui::FullOutput) -> usize {
    let primitives = ctx.tessellate(output.shapes, output.pixels_per_point);
    let meshes = primitives.iter().map(|p| match &p.primitive {
        egui::epaint::Primitive::Mesh(mesh) => mesh.indices.len() / 3,
        egui::epaint::Primitive::Callback(_) => 1,
    });
    meshes.sum()
}

/// The arrows alone, as `egui_plot` has them.
fn plain(ctx: &Context, tails: &[[f64; 2]], tips: &[[f64; 2]]) -> usize {
    let input = RawInput {
        screen_rect: Some(Rect::from_min_size(pos2(0.0, 0.0), vec2(1280.0, 800.0))),
        ..RawInput::default()
    };
    let mut output = ctx.run_ui(input, |ui| {
        Plot::new("arrows").data_aspect(1.0).show(ui, |plot| {
            let points = |p: &[[f64; 2]]| p.iter().copied().collect::<PlotPoints<'_>>();
            plot.arrows(Arrows::new("arrows", points(tails), points(tips)));
        });
    });
    output.textures_delta.clear();
    triangles(ctx, output)
}

fn arrows(samples: usize) -> (Vec<[f64; 2]>, Vec<[f64; 2]>) {
    let tail = |i: usize| {
        let (sin, cos) = (i as f64 * 3.883).sin_cos();
        [250.0 * cos, 250.0 * sin]
    };
    let tails: Vec<_> = (0..samples).map(tail).collect();
    let tips = tails.iter().map(|[x, y]| [1.1 * x, 1.1 * y]).collect();
    (tails, tips)
}

/// The median of some runs, ms.
#[allow(
    clippy::disallowed_methods,
    reason = "this measures time; nothing that is computed depends on it"
)]
fn median_ms(runs: usize, mut run: impl FnMut() -> usize) -> f64 {
    let mut times: Vec<f64> = (0..runs)
        .map(|_| {
            let start = Instant::now();
            black_box(run());
            start.elapsed().as_secs_f64() * 1e3
        })
        .collect();
    times.sort_unstable_by(f64::total_cmp);
    times[runs / 2]
}

/// Samples of six regions, counted one by one.
fn counted(q: &[f64], regions: &[Region]) -> usize {
    let assignment = Assignment::new(regions);
    let mut counts = vec![0_usize; regions.len()];
    for region in q.iter().filter_map(|q| assignment.region_of(*q)) {
        counts[region] += 1;
    }
    counts[0]
}

/// A boundary under the hand, on the largest session.
fn drag(group: &mut BenchmarkGroup<'_, WallTime>) {
    let samples = SIZES[SIZES.len() - 1];
    let mut window = Window::dragging(samples);
    let whole = median_ms(201, || window.dragged());
    let q: Vec<f64> = (0..samples)
        .map(|i| ((i as f64 * 0.618_033_988_75).fract() * 360.0 - 180.0).to_radians())
        .collect();
    let region = |k: u8| Region {
        name: k.to_string(),
        from_rad: (60.0 * f64::from(k) - 180.0).to_radians(),
        to_rad: (60.0 * f64::from(k) - 120.0).to_radians(),
    };
    let regions: Vec<Region> = (0..6).map(region).collect();
    let counting = median_ms(7, || counted(&q, &regions));
    eprintln!(
        "{samples} samples, a boundary dragged: the whole window {whole:.2} ms; counting one by \
         one would add {counting:.2} ms, ratio {:.4}",
        whole / (whole + counting)
    );
    let name = BenchmarkId::new("drag", samples);
    group.bench_function(name, |bencher| bencher.iter(|| window.dragged()));
}

/// The same window in 3-D: the pointer moves, and the camera orbits.
fn in_space(group: &mut BenchmarkGroup<'_, WallTime>, window: &mut Window, samples: usize) {
    window.frame(vec![Event::Key {
        key: Key::Num5,
        physical_key: None,
        pressed: true,
        repeat: false,
        modifiers: Modifiers::COMMAND | Modifiers::SHIFT,
    }]);
    window.frame(Vec::new());
    let moves = median_ms(101, || window.moved());
    window.frame(vec![Event::PointerMoved(pos2(560.0, 330.0))]);
    window.frame(vec![Event::PointerButton {
        pos: pos2(560.0, 330.0),
        button: PointerButton::Primary,
        pressed: true,
        modifiers: Modifiers::NONE,
    }]);
    let orbits = median_ms(101, || window.moved());
    eprintln!(
        "{samples} samples in 3-D: the pointer moves {moves:.2} ms, the camera orbits {orbits:.2} ms"
    );
    let name = BenchmarkId::new("the camera orbits in 3-D", samples);
    group.bench_function(name, |bencher| bencher.iter(|| window.moved()));
}

fn frame_time(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("frame");
    group.sample_size(10);
    for samples in SIZES {
        let mut window = Window::new(samples);
        let whole = median_ms(101, || window.moved());
        let ctx = Context::default();
        let (tails, tips) = arrows(samples);
        plain(&ctx, &tails, &tips);
        let alone = median_ms(7, || plain(&ctx, &tails, &tips));
        eprintln!(
            "{samples} samples: the whole window {whole:.2} ms, egui_plot's arrows alone \
             {alone:.2} ms, ratio {:.4}",
            whole / alone
        );
        let name = BenchmarkId::new("the whole window", samples);
        group.bench_function(name, |bencher| bencher.iter(|| window.moved()));
        in_space(&mut group, &mut window, samples);
        let name = BenchmarkId::new("egui_plot's arrows alone", samples);
        group.bench_function(name, |bencher| bencher.iter(|| plain(&ctx, &tails, &tips)));
    }
    drag(&mut group);
    group.finish();
}

criterion_group!(benches, frame_time);
criterion_main!(benches);
