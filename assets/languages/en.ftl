# English: every text of the window. A language is a file like this one; see docs/languages.md.

## actions

actions-open-a-session-first = Open a session first
actions-redo = Redo
actions-nothing-was-undone = Nothing was undone
actions-undo = Undo
actions-nothing-was-changed-yet = Nothing was changed yet
actions-import = Import…
actions-save-session-as = Save session as…
actions-save-session-to-path = Save session to path…
actions-compensate-targets = Compensate targets…
actions-save-table = Save table…
actions-read-the-file-again = Read the file again
actions-the-session-is-in-no = The session is in no file yet
actions-the-samples-are-in-no = The samples are in no file of their own
actions-history-of-the-machine = History of the machine…
actions-record-from-an-instrument = Record from instrument…
actions-quit = Quit
actions-cancel-what-is-running = Cancel what is running
actions-nothing-is-running = Nothing is running
actions-choose-a-sample = Choose a sample in a plot or in the table
actions-preferences = Preferences…
actions-workspace-from-above = Workspace from above
actions-workspace-from-the-side = Workspace from the side
actions-workspace-from-the-front = Workspace from the front
actions-deviation-around-the-angle = Deviation around the angle
actions-workspace-in-3-d = Workspace in 3-D
actions-show-everything-in-the-plots = Show everything in the plots
actions-this-robot-has-no-such = This robot has no such step
actions-about-truepose = About truepose
actions-all-commands = All commands…
actions-include-again = Include { $what } again
actions-exclude = Exclude { $what }
actions-stop-following-the-file = Stop following the file
actions-lengths-in-m = Lengths in µm
actions-lengths-in-inches = Lengths in inches
actions-lengths-in-mm = Lengths in mm
actions-angles-in-radians = Angles in radians
actions-angles-in-mrad = Angles in mrad
actions-angles-in-arcsec = Angles in arcsec
actions-angles-in-degrees = Angles in degrees
actions-light = Light
actions-dark = Dark
actions-hide-results = Hide results
actions-show-results = Show results

## common

common-identify-the-robot-first = Identify the robot first
common-open = Open…
common-new-by-simulation = New by simulation…
common-save-session = Save session
common-save-model = Save model…
common-report-details = Report details…
common-report = Report…
common-identify = identify
common-identify-2 = Identify
common-run-diagnosis = Run diagnosis
common-3-d-view-isometric = 3-D view, isometric
common-3-d-view = 3-D view from the front
common-3-d-view-from-the-side = 3-D view from the side
common-3-d-view-from-above = 3-D view from above
common-glossary = Glossary
common-keyboard-and-mouse = Keyboard and mouse
common-follow-the-file-as = Follow the file as it grows
common-time = time
common-joints = joints
common-table = table
common-before = before
common-after = after
common-effect = effect
common-without = without it
common-moving-positive = moving positive
common-negative = negative
common-noise-alone = noise alone
common-samples = samples
common-noise = noise
common-degrees = degrees
common-radians = radians
common-there-is-no-such-region = there is no such region
common-tolerance = tolerance
common-from = from
common-to = to
common-step = step
common-corrected = corrected
common-cancel = Cancel
common-done = Done
common-excluded = excluded
common-session = Session
common-decimal-sign = Decimal sign
common-lengths = Lengths in
common-none = none
common-which-robot-was-measured = Which robot was measured
common-tool = Tool
common-save-table = Save table
common-save-model-2 = Save model
common-save-measuring-list = Save measuring list
common-save-report = Save report
common-save-picture = Save picture
common-save-corrected-file = Save corrected file
common-instrument = Instrument
common-targets-and-programs = Targets and programs
common-table-2 = Table
common-and-more = and { $more } more
common-the-simulation-needs-other-numbers = The simulation needs other numbers
common-deviation = deviation
common-direction = direction
common-export = Export
common-chart = Chart
common-copy-table = Copy table
common-within-tolerance = within tolerance
common-noise-floor = noise floor
common-testable-effects = testable effects
common-of = { $yes } of { $no }
common-is-not-there-any-more = { $name } is not there any more
common-not-yet = not yet
common-joint = joint
common-not-correctable-by-joint-commands = not correctable by joint commands
common-robot = robot
common-rms-error = RMS error
common-show-these-samples = Show these samples
common-estimated = estimated
common-held-out = held out
common-the-fit-did-not-converge = the fit did not converge: { $stopped }
common-sample = sample { $sample }
common-identified = identified
common-searching = searching
common-continue-to-export = Continue to export
common-regions = regions
common-recent-files = Recent files
common-forget = Forget { $name }
common-measured = measured
common-there-are-no-samples = there are no samples to draw
common-continue-to-identify = Continue to identify
common-results = Results
common-instrument-2 = instrument
common-open-2 = Open
common-workspace = Workspace
common-dismiss = Dismiss
common-within = within
common-outside = outside
common-vectors = vectors
common-heat-map = heat map
common-load = load
common-temperature = temperature
samples =
    { $count ->
        [one] { $count } sample
       *[other] { $count } samples
    }
regions =
    { $count ->
        [one] { $count } region
       *[other] { $count } regions
    }
effects =
    { $count ->
        [one] { $count } effect
       *[other] { $count } effects
    }
nothing = {""}

## keys

keys-redo = redo
keys-undo = undo
keys-open-the-last-file-again = open the last file again
keys-open-a-file = open a file
keys-import-what-an-instrument-wrote = import what an instrument wrote
keys-first-example = first example
keys-second-example = second example
keys-third-example = third example
keys-new-by-simulation = new by simulation
keys-save-session-as = save session as
keys-save-session = save session
keys-save-session-to-a-path = save session to a path
keys-save-model = save model
keys-correct-targets-or-a-program = correct targets or a program
keys-save-table = save table
keys-save-the-report = save the report
keys-read-the-file-again = read the file again
keys-follow-the-file-or-stop = follow the file, or stop
keys-report-details = what the report states of customer and machine
keys-history-of-the-machine = compare the sessions of this machine
keys-record-from-an-instrument = record from an instrument
keys-quit = quit
keys-search-for-what-is-missing = search for what is missing
keys-cancel = cancel
keys-exclude-the-chosen-samples-or = exclude the chosen samples, or include them again
keys-preferences = preferences
keys-other-unit-of-angles = other unit of angles
keys-next-unit-of-lengths = next unit of lengths
keys-light-or-dark = light or dark
keys-results-or-more-room = results, or more room for plots
keys-workspace-from-above = workspace from above
keys-workspace-from-the-side = workspace from the side
keys-workspace-from-the-front = workspace from the front
keys-deviation-around-the-angle-polar = deviation around the angle (polar)
keys-workspace-in-3-d = workspace in 3-D
keys-fit-the-plots-view = fit the plots' view
keys-the-same = the same
keys-first-step = first step
keys-second-step = second step
keys-third-step = third step
keys-fourth-step = fourth step
keys-fifth-step-where-there-are = fifth step, where there are regions
keys-about-truepose = about truepose
keys-glossary = glossary
keys-this-list = this list
keys-all-commands-by-a-word = all commands, by a word of their name
keys-move-the-boundary-that-has = move the boundary that has the focus
keys-move-it-further = move it further
keys-orbit-and-zoom-the-3 = orbit and zoom the 3-D view that has the focus
keys-next-control-the-one-before = next control, the one before
keys-space-or-enter = Space or Enter
keys-press = press it
keys-larger-smaller-usual-text = larger, smaller, usual text
keys-close-a-sheet = close a sheet
keys-the-mouse-in-the-plots = The mouse, in the plots

## over

over-no-sample-has-a-joint = No sample has a joint value
over-every-sample-needs-its-q1 = Every sample needs its q1 cell
over-no-time-was-logged = No time was logged
over-a-column-time-s-would = A column time_s would show whether the deviation drifts while you measure, and when somebody touched the tripod
over-no-load-was-logged = No load was logged
over-a-column-load-kg-would = A column load_kg would show whether the arm gives way under what it carries: measure some poses empty and the same ones loaded
over-no-temperature-was-logged = No temperature was logged
over-a-column-temperature-c-would = A column temperature_c would show whether the deviation follows the machine's warmth
over-the-joints-motion-was-not = The joint's motion was not logged
over-columns-speed1-deg-s = Columns speed1_deg_s and dir1 would show how the deviation follows the motion
over-time-since-the-first-sample = time since the first sample
over-speed-of = speed of { $joint }
over-travel-of-since-it-reversed = travel of { $joint } since it reversed

## by-joint

by-joint-deviation-by-joint = Deviation by joint
by-joint-the-deviation-over-every-joint = The deviation over every joint, each from its smallest to its largest value. A curve in one panel is an error of that joint
by-joint-every-sample-needs-its-joint = Every sample needs its joint values and what was measured
by-joint-no-sample-to-show = No sample to show
by-joint-each-over-the-range = joint, each over the range shown
by-joint-deviation-by-joint-2 = { $name } deviation by joint
by-joint-deviation-by-joint-3 = deviation by joint, { $name }
by-joint-deviation-of-samples-over-joints = { $name } deviation of { $samples } samples over { $joints } joints, { $from } to { $to }

## correction

correction-correction-table = Correction table
correction-this-format-describes-the-robot = This format describes the robot itself and has no table
correction-correction-table-as-a-curve = correction table as a curve
correction-the-same-for-both-directions = the same for both directions
correction-solid-moving-positive-dashed-moving = solid: moving positive · dashed: moving negative
correction-correction-table-2 = correction table
correction-correction = correction, { $unit }

## deviation

deviation-angle = angle
deviation-deviation-over-angle = Deviation over angle
deviation-deviation-over-time = Deviation over time
deviation-deviation-over-load = Deviation over load
deviation-deviation-over-temperature = Deviation over temperature
deviation-deviation-chart = deviation chart, { $component }
deviation-chart = { $chart } chart, { $component }
deviation-deviation-over = { $name } deviation over { $label }
deviation-to = { $component } to { $first }
deviation-the-never-changes = the { $what } never changes
deviation-from-the-smallest = from the smallest to the largest in each column
deviation-one-sample-has-no-value = one sample has no value and is not shown
deviation-samples-have-no-value = { $n } samples have no value and are not shown
deviation-to-2 = { $from } to { $to }
deviation-no-sample-to-show = no sample to show
deviation-deviation-of-samples-over = { $component } deviation of { $samples } samples over { $label } from { $from } to { $to }
deviation-tolerance = , tolerance { $tolerance }

## curve

curve-effects-own-curve = Effect's own curve
curve-curve = curve of { $curve }, { $component }
curve-there-is-no-curve = There is no curve to show
curve-run-the-diagnosis-again-what = Run the diagnosis again: what was found belongs to other samples
curve-without = without { $what }
curve-what-it-does = what it does
curve-residual-without-and-what = { $component } residual without { $what }, and what it does
curve-what-is-left-without-all = what is left without { $curve }; all else as fitted
curve-it-depends-on-the-pose = it depends on the pose too: its value at each sample
curve-a-set-up-error = a set-up error is not corrected yet and shows here too
curve-over-it-moves-the-deviation = { $curve } over { $label }: it moves the { $component } deviation from { $from } to { $to }; without it { $before } root mean square are left, with it { $after }

## chart-gap

chart-gap = gap
chart-gap-by-step = Gap by step
chart-gap-nothing-is-identified-yet = nothing is identified yet
chart-gap-rms-over-the-fitted-samples = RMS over the fitted samples
chart-gap-by-step-2 = gap by step: { $steps }

## histogram

histogram-bars-as-wide-as = bars as wide as the spread of the samples asks for
histogram-histogram = histogram
histogram-histogram-2 = Histogram
histogram-histogram-3 = histogram, { $component }
histogram-no-sample-can-be-counted = No sample can be counted
histogram-every-sample-lacks-a-joint = Every sample lacks a joint value or a coordinate
histogram-click = click
histogram-marks-them = marks them
histogram-tolerance = {" "}tolerance{" "}
histogram-samples-by-deviation = samples by { $name } deviation
histogram-deviation = { $name } deviation, { $units }
histogram-within = within { $sign }{ $tolerance }: { $counts } of { $all }
histogram-one-lies-beyond-the-ends = one lies beyond the ends
histogram-lie-beyond-the-ends = { $n } lie beyond the ends
histogram-wide = { $width } { $unit } wide { $rule }
histogram-most = most, { $bin }, from { $from } to { $to }
histogram-how-many-samples-have-which = how many samples have which { $component } deviation

## orders

orders-orders = orders
orders-order-spectrum = Order spectrum
orders-order-spectrum-2 = order spectrum, { $component }
orders-orders-are-cycles-per-turn = Orders are cycles per turn. Choose a joint that turns
orders-slides = { $name } slides
orders-too-few-different-angles = Too few different angles
orders-an-order-shows-where = An order shows where a wave comes back with every turn: measure thirty angles or more, spread over the whole range of the joint
orders-usual-cause = usual cause
orders-noise = noise, { $name }
orders-order = order { $order }
orders-deviation-by-order-over = { $name } deviation by order over { $joint }
orders-cycles-per-turn = cycles per turn of { $joint }
orders-amplitude = amplitude, { $unit }
orders-too-few-samples-to-say = too few samples to say what is noise
orders-order-2 = order { $order }{ $cause } with { $amplitude }
orders-nothing-above-the-noise = nothing above the noise
orders-orders-of-the-deviation-before = { $orders } orders of the { $component } deviation; before: { $before }
orders-after = ; after: { $after }
orders-noise-stays-below-the-line = noise stays below the line in 99 of 100 sessions
orders-range-orders-nearer-than-cannot = range { $range }°: orders nearer than { $apart } cannot be told apart
orders-and-order-1-cannot-be = , and order 1 cannot be seen
orders-and-orders-up-to-cannot = , and orders up to { $n } cannot be seen
orders-eccentricity = eccentricity
orders-two-cycle = two-cycle
orders-gear = gear

## quantiles

quantiles-quantiles = quantiles
quantiles-normal-quantiles = Normal quantiles
quantiles-each-samples-residual-over = Each sample's residual over the place that noise would give it. On the line there is nothing but noise; ends that turn away from it are outliers, a bend or a step in the middle is an error that the model lacks
quantiles-nothing-to-compare = Nothing to compare with the normal distribution
quantiles-choose-a-component-that-has = Choose a component that has a sign, of four samples or more
quantiles-normal-quantiles-2 = normal quantiles, { $name }
quantiles-residuals-of-samples-over-normal = { $name } residuals of { $samples } samples over normal quantiles; the middle half is spread like noise of { $sigma }
quantiles-residuals-over-normal-quantiles = { $name } residuals over normal quantiles
quantiles-what-noise-alone-would-be = what noise alone would be, σ
quantiles-the-line-has-the-slope = the line has the slope of σ = { $sigma }

## boundary-entry

boundary-entry-milliradians = milliradians
boundary-entry-seconds-of-arc = seconds of arc
boundary-entry-the-angle-is-missing-type = the angle is missing; type it in { $name }, such as { $example }
boundary-entry-is-no-angle-type = '{ $text }' is no angle; type a number of { $name }, such as { $example }
boundary-entry-a-boundary-is-an-angle = a boundary is an angle; type a number
boundary-entry-is-outside-of-the-joints = { $at } is outside of the joint's range { $range }; { $same } is the same direction: type that
boundary-entry-is-outside-of-the-joints-range = { $at } is outside of the joint's range { $range }; type an angle in it
boundary-entry-at-most = at most { $from }
boundary-entry-at-least = at least { $to }
boundary-entry-region-would-overlap-region-type = region { $next } would overlap region { $other }, { $from } … { $to }; type { $free }, or merge the two
boundary-entry-type-or-more = type { $least } or more
boundary-entry-type-or-less = type { $most } or less
boundary-entry-region-would-begin-and-end = region { $name } would begin and end at { $from }; { $instead }
boundary-entry-region-would-be-wide-less = region { $name } would be { $width } wide, less than { $least }; { $instead }
boundary-entry-region-would-run-from-over = region { $name } would run from { $from } over { $limit } to { $to }; no region does: make two, one to { $first } and one from { $second }
boundary-entry-region-would-begin-at-after = region { $name } would begin at { $from }, after its end at { $to }; { $instead }

## compensated

compensated-neither-its-ending-nor-its = { $path }: neither its ending nor its content says what it is; expected { $all }

## division

division-one-region-nowhere-does = One region: nowhere does the deviation change by more than the noise
division-regions-a-boundary-where = { $n } regions: a boundary where the deviation changes by more than the noise
division-they-leave-even-ones = { $first }. They leave { $left }, { $n } even ones { $even }

## edit

edit-nothing-was-measured-yet-open = nothing was measured yet: open a session that was measured on this robot
edit-regions-are-for-a-single = regions are for a single joint that turns
edit-a-tolerance-is-a-number = a tolerance is a number above 0
edit-a-table-needs-a-joint = a table needs a joint of the robot and a step above 0
edit-there-is-no-such-effect = there is no such effect
edit-no-sample-would-be-left = no sample would be left to fit
edit-no-sample-would-be-left-2 = no sample would be left
edit-open-session = open session
edit-open-model = open model
edit-divide-into-regions = divide into regions
edit-move-boundary = move boundary
edit-divide-adaptively = divide adaptively
edit-keep-the-regions = keep the regions
edit-split-region = split region
edit-merge-regions = merge regions
edit-delete-region = delete region
edit-rename-region = rename region
edit-take-regions-from-session = take regions from session
edit-choose-method = choose method
edit-choose-effects = choose effects
edit-set-tolerance = set tolerance
edit-choose-table = choose table
edit-add-to-model = add to model
edit-switch-effect = switch effect on
edit-switch-effect-off = switch effect off
edit-edit-robot-and-instrument = edit robot and instrument
edit-exclude-samples = exclude samples
edit-include-samples = include samples
edit-mend-data = mend data
edit-restore = restore
edit-the-boundary-cannot-be-moved = the boundary cannot be moved there
edit-the-region-is-too-narrow = the region is too narrow to be split
edit-no-region-begins-where-this = no region begins where this one ends; type its end at the next one first
edit-the-last-region-stays-without = the last region stays: without one nothing is corrected
edit-a-region-needs-a-name = a region needs a name
edit-another-region-is-called-choose = another region is called { $name }; choose another name

## loaded-session

loaded-session-length = length
loaded-session-tangential = tangential
loaded-session-radial = radial
loaded-session-axial = axial

## search

search-set-up-errors = set-up errors
search-noise-outliers-candidates = noise, outliers, candidates
search-search = search
search-other-explanations = other explanations
search-poses-to-measure-next = poses to measure next
search-the-search-was-cancelled = the search was cancelled

## setup

setup-a-joint-needs-a-name = a joint needs a name
setup-another-joint-is-called = another joint is called { $form }
setup-the-noise-is-a-number = the noise is a number above 0
setup-a-reflector-needs-a-name = a reflector needs a name
setup-another-reflector-is-called = another reflector is called { $name }
setup-limits-run-from-the-smaller = limits run from the smaller to the larger value
setup-a-mass-is-0-kg = a mass is 0 kg or more
setup-robot-and-instrument = Robot and instrument
setup-joint = Joint { $k }, { $joints }
setup-tool-and-gravity = Tool and gravity
setup-reflectors = Reflectors
setup-not-taken-over-while-something = Not taken over while something is wrong
setup-back-to-what-was-there = Back to what was there
setup-name-of-joint = Name of joint { $n }
setup-turns = turns
setup-slides = slides
setup-axis-direction-at-home = axis, direction at home
setup-axis = Axis { $n }
setup-a-point-on-it-mm = a point on it, mm
setup-point = Point { $n }
setup-limits-of-joint = limits of joint { $n }, { $unit }
setup-limit = Limit { $n }
setup-mass-of-link-kg = mass of link { $n }, kg
setup-mass = Mass { $n }
setup-its-centre-at-home-mm = its centre at home, mm
setup-centre = Centre { $n }
setup-tool-at-home-mm = tool at home, mm
setup-orientation-quaternion-w-x-y = orientation, quaternion w x y z
setup-orientation = Orientation
setup-gravity-is-known-m-s = gravity is known, m/s²
setup-gravity = Gravity
setup-in-the-tool-frame-mm = in the tool frame, mm
setup-name-of-reflector = Name of reflector { $n }
setup-reflector = Reflector { $n }
setup-remove-this-reflector = Remove this reflector
setup-add-a-reflector = Add a reflector
setup-name-of-the-instrument = Name of the instrument
setup-noise-one-mm = noise, one σ, mm
setup-unknown = unknown
setup-one-number = one number
setup-noise = Noise

## simulation

simulation-nominal-radius = nominal radius
simulation-zero-offset = zero offset
simulation-length-error = length error
simulation-this-field-needs-a-number = this field needs a number
simulation-the-radius-has-to-be = the radius has to be above 0 mm
simulation-the-tolerance-cannot-be-below = the tolerance cannot be below 0
simulation-the-sweep-has-to-run = the sweep has to run from the smaller to the larger angle
simulation-the-step-has-to-be = the step has to be above 0°
simulation-that-is-more-than = that is more than a million poses; take a larger step
simulation-the-noise-cannot-be-below = the noise cannot be below 0
simulation-every-field-needs-a-number = every field needs a number
simulation-new-by-simulation = New by simulation
simulation-a-lamp-on-one-turning = A lamp on one turning axis, measured by a tracker. What is filled in here is what identification should find
simulation-what-stands-in-colour-above = What stands in colour above has to be another number first
simulation-simulate = Simulate
simulation-robot = Robot
simulation-tolerance = Tolerance
simulation-sweep = Sweep
simulation-there-and-back = there and back
simulation-seed = seed
simulation-other-effects = Other effects
simulation-remove = Remove
simulation-add-an-effect = Add an effect…
simulation-add-an-effect-2 = Add an effect

## about

about-calibrates-a-robot-at-commissioning = Calibrates a robot at commissioning: finds where measurement and simulation disagree, and writes what the controller needs
about-everything-in-this-window-can = Everything in this window can be done in the terminal too: truepose --help
about-type-inter-by-the-inter = Type: Inter, by the Inter project authors, SIL Open Font License 1.1
about-version = version { $version }

## compensation

compensation-compensate = Compensate { $name }
compensation-save-corrected-file = Save corrected file…
compensation-load-where-the-file-says = load where the file says none
compensation-the-measuring-frame = the measuring frame is the robot's base (--measured-frame)
compensation-tool-of-the-program = Tool of the program
compensation-frame-of-the-program = Frame of the program
compensation-as-modelled = the model's tool or base (--as-modelled)
compensation-as-programmed = as the program writes it (--as-programmed)
compensation-read-as = read as
compensation-of = { $corrected } of { $targets }
compensation-targets-corrected = targets corrected
compensation-rms-position-error = RMS position error
compensation-largest-position-error = largest position error
compensation-lines-that-change = Lines that change
compensation-line = line
compensation-is-left-as = { $name } is left as it is: { $left }
compensation-not-corrected = not corrected: { $says }
compensation-line-column = line { $line }, column { $column }: { $says }
compensation-and-more-all-of-them = and { $more } more: all of them stand in the file beside the saved one

## import

import-more-options = More options of this kind of file
import-not-imported = not imported
import-point-name = point name
import-group-of-points = group of points
import-reflector = reflector
import-unit-as-chosen = { $axis }, unit as chosen
import-joint-commanded = joint { $n } commanded, { $sign }
import-joint-read-back = joint { $n } read back, { $sign }
import-side-joint-came = side joint { $n } came from
import-speed-of-joint-s = speed of joint { $n }, °/s
import-load-kg = load, kg
import-temperature-c = temperature, °C
import-time-s = time, s
import-setup-of-the-instrument = setup of the instrument
import-fit-held-out-or-excluded = fit, held-out or excluded
import-orientation = orientation { $part }
import-as-you-said = as you said
import-for-certain = for certain
import-guessed-from-the-header = guessed from the header
import-guessed-from-the-values = guessed from the values
import-columns-what-each-is-how = Columns: what each is, how that is known, its heading, first rows
import-before-the-table = Before the table: { $lines }
import-of-columns-are-guessed-compare = { $guesses } of { $columns } columns are guessed: compare them with the first rows
import-the-columns-are-right = The columns are right
import-meaning-of-column = Meaning of column { $k }
import-where-the-robot-was-sent = Where the robot was sent, if the table does not say it
import-file-of-the-commands = File of the commands
import-a-table-with-q1-deg = a table with q1_deg, … and perhaps name, time_s, dir1, load_kg
import-by-order = by order
import-by-name = by name
import-by-time = by time
import-matched = Matched
import-as-it-suits = as it suits
import-the-mean-of-each-stop = the mean of each stop
import-all = all
import-samples-are = Samples are
import-clocks-apart = Clocks apart by
import-found-from-the-motion = found from the motion
import-typed = typed
import-seconds-to-add = Seconds to add to a measured time
import-the-measured-clock-needs-s = The measured clock needs { $offset_s } s to agree with the commands, ± { $sigma } s (95 %); { $rms } mm are left
import-with-s-added-mm-are = With { $offset_s } s added, { $rms } mm are left between path and measurements
import-points-known-in-the-base = Points known in the base frame, if the instrument has a frame of its own
import-file-of-the-known-points = File of the known points
import-a-table-with-name-x = a table with name, x_mm, y_mm, z_mm; the same names as in the measured file
import-fit-a-scale-too = fit a scale too
import-points-fit-with-mm-root = { $used } points fit with { $rms } mm (root mean square)
import-excluded-measured-or-surveyed-wrongly = , { $left_out } excluded: measured or surveyed wrongly, or moved since
import-scaled-by-ppm = scaled by { $scale } ({ $ppm } ppm)
import-point = point
import-off-by-mm = off by, mm
import-in-x = in x
import-in-y = in y
import-in-z = in z
import-reflectors-in-the-tool-frame = Reflectors in the tool frame, if there are several
import-file-of-the-reflectors = File of the reflectors
import-a-table-with-name-x-mm = a table with name, x_mm, y_mm, z_mm; without it one sits at the tool's origin
import-rows = { $rows } rows
import-separated = separated by { $separator }
import-header-in-line = header in line { $line }
import-no-header = no header
import-unit = unit: { $found }
import-name-of-the-session = Name of the session
import-source = Source
import-what-wrote-the-file = What wrote the file
import-commas = commas
import-semicolons = semicolons
import-tabs = tabs
import-spaces = spaces
import-separated-2 = Separated by
import-header = header
import-as-the-headings-say = as the headings say
import-angles = angles in
import-as-the-file-says = as the file says
import-inches = inches
import-y-points-up-turn = y points up: turn it so that z does
import-joint-measured = Joint measured
import-as-found = as found
import-in-line = in line
import-line-of-the-header = Line of the header
import-take = Take
import-choose-it-in-the-table = Choose it in the table above
import-it = It is { $answer }
import-import = Import { $name }
import-import-2 = Import
import-looking-at-the-file-was = Looking at the file was cancelled
import-look-again = Look again
import-stop-looking = Stop looking
import-warning = Warning:{" "}
import-error = Error:{" "}
import-choose = Choose…
import-choose-2 = Choose: { $label }
import-use-which-lies-beside = Use { $file }, which lies beside it
import-taken-by-its-name = Taken because its name is that of the file
import-use = Use { $file }: { $label }
import-what-the-import-brings = What the import brings
import-to-fix = To fix
import-mm-from-the-nominal-robot = , { $rms } mm from the nominal robot
import-matched-by-unmatched-measured-commanded = ; matched by { $id }; unmatched: { $lonely_measurements } measured, { $lonely_commands } commanded
import-that-of-the-open-session = that of the open session, { $here }
import-that-of-the-example = that of the example { $example }
import-the-one-in-this-file = the one in this file
import-file-of-the-robot = File of the robot
import-a-robot-a-session-or = a robot, a session, or a URDF file
import-base = Base
import-link-of-the-base = Link of the base
import-tip = Tip
import-link-of-the-tool = Link of the tool
import-name-of-a-link = name of a link
import-one-axis-that-turns-typed = one axis that turns, typed here
import-name = Name
import-name-of-the-robot = Name of the robot
import-axis-at-home = Axis at home
import-axis = Axis
import-point-on-it-mm = Point on it, mm
import-point-2 = Point
import-tool-at-home-mm = Tool at home, mm
import-travel = Travel, °
import-travel-2 = Travel
import-gravity-points-along-z = gravity points along −z
import-one-joint-that-turns = one joint that turns
import-one-joint-that-slides = one joint that slides
import-joints-of-which-turn = { $count } joints, { $turns } of which turn
import-tool-mm-from-the-base = { $robot }: { $joints }, tool { $reach } mm from the base
import-looking-at-the-file = Looking at the file…
import-a-table-of-at-most = a table of at most 1000 MB: export fewer points, or cut it into parts
import-answer-what-is-asked-above = Answer what is asked above first
import-the-file-cannot-be-read = The file cannot be read like this
import-look-at-the-columns-above = Look at the columns above, and confirm them
import-give-the-session-a-name = Give the session a name
import-say-whose-robot-was-measured = Say whose robot was measured
import-say-which-file-the-robot = Say which file the robot is in
import-the-robot-cannot-be-read = The robot cannot be read like this
import-the-travel-runs = the travel runs from the smaller to the larger value
import-the-tool-lies = the tool lies on the axis: say where it is at home, off the axis
import-a-robot-needs-a-name = a robot needs a name
import-and-more = and { $more } more
import-clocks-apart-2 = “Clocks apart by”
import-matched-by-order-or = “Matched” by order or by name
import-matched-by-name-or = “Matched” by name or by time
import-matched-by-order = “Matched” by order
import-matched-2 = “Matched”
import-samples-are-all = “Samples are” all
import-samples-are-2 = “Samples are”
import-a-file-of-commands = a file of commands with
import-a-file-of-commands-2 = a file of commands
import-a-file-of-reflectors = a file of reflectors with
import-a-file-of-known-points = a file of known points
import-angles-2 = “Angles in”
import-separated-3 = “Separated by”
import-decimal-sign = “Decimal sign”
import-the-columns-above-as = the columns above as
import-y-points-up = “y points up”
import-fit-a-scale = “fit a scale”
import-joint-measured-2 = “Joint measured”
import-lengths = “Lengths in”

## palette

palette-what-to-do = what to do
palette-command = Command
palette-no-command-has-this = No command has this in its name

## path

path-the-samples-are-written-beside = The samples are written beside it, as a CSV file of the same name
path-path-to-save = Path to save to
path-in-the-folder = { $name }, in the folder { $folder }
path-replace-the-file-if = replace the file if it exists
path-save = Save
path-a-file-that-says-what = A file that says what the table means is written beside it
path-the-model-can-be-exported = The model can be exported and verified later
path-a-csv-table = A CSV table with the session's column names, to be measured next
path-a-name-that-ends = A name that ends in .html or .pdf; a session that was not searched yet is searched first
path-a-name-that-ends-in-svg-or-png = A name that ends in .svg or .png
path-what-was-changed-is-written = What was changed is written beside it, as NAME.meta.json

## preferences

preferences-preferences = Preferences
preferences-inch = inch
preferences-angles = Angles in
preferences-readable = readable
preferences-decimals-of-lengths = Decimals of lengths
preferences-as-the-system = as the system
preferences-light = light
preferences-dark = dark
preferences-colours = Colours
preferences-size-of-text = Size of text
preferences-files-are-read-and-written = Files are read and written in their own units, whatever is shown here
preferences-reset-all = Reset all
preferences-language = Language

## recovery

recovery-not-saved-when-the-program = Not saved when the program ended
recovery-the-last-time-the-program = The last time the program ended without warning. Nothing is lost unless it is discarded here: what is not restored now is offered again
recovery-a-file-that-is-damaged = A file that is damaged
recovery-kept = kept
recovery-its-file = its file
recovery-discard = Discard
recovery-restore = Restore
recovery-put-it-aside = Put it aside
recovery-discard-all = Discard all
recovery-discard-all-for-good = Discard all { $count } for good
recovery-not-now = Not now
recovery-less-than-a-minute-ago = less than a minute ago
recovery-its-first-line-is-not = its first line is not complete
recovery-its-first-line-cannot-be = its first line cannot be read
recovery-expected-the-format = expected the format { $format }
recovery-of-bytes-are-there = { $document } of { $bytes } bytes are there
recovery-its-contents-do-not-agree = its contents do not agree with their hash
recovery-minutes-ago =
    { $count ->
        [one] { $count } minute ago
       *[other] { $count } minutes ago
    }
recovery-hours-ago =
    { $count ->
        [one] { $count } hour ago
       *[other] { $count } hours ago
    }
recovery-days-ago =
    { $count ->
        [one] { $count } day ago
       *[other] { $count } days ago
    }

## unsaved

unsaved-leave-without-saving = Leave without saving?
unsaved-leave-without-saving-2 = Leave without saving
unsaved-open-without-saving = Open without saving?
unsaved-open-without-saving-2 = Open without saving
unsaved-simulate-without-saving = Simulate without saving?
unsaved-simulate-without-saving-2 = Simulate without saving
unsaved-changes-of-are-not = Changes of { $name } are not in its file, { $file }
unsaved-the-session-is-in-no = The session { $name } is in no file
unsaved-what-was-identified = What was identified from { $name } is in no file
unsaved-go = Go on
unsaved-replace-what-another-program-wrote = Replace what another program wrote?
unsaved-changed-since-it-was-read = { $path } changed since it was read. Saving here would replace what was written there
unsaved-save-under-another-name = Save under another name…
unsaved-replace = Replace it

## glossary

glossary-the-same-stands-beside = The same stands beside the numbers, where the pointer rests on a name

## settings

settings-they-were-damaged-and-are = they were damaged and are kept as { $aside }
settings-is-damaged = { $path } is damaged

## file

file-it-was-cancelled = it was cancelled
file-exists-already-allow-replacing = { $path } exists already; allow replacing it, or choose another name
file-is-a-folder-or = { $path } is a folder or a device and cannot be replaced; choose another name
file-the-disk-is-full-make = the disk is full: make room on it, or save to another disk
file-the-disk-can-only-be = the disk can only be read: save to another disk
file-nothing-may-be-written-there = nothing may be written there: save to another folder
file-the-folder-is-not-there = the folder is not there: choose another, or make it first
file-the-name-is-too-long = the name is too long, or has a sign in it that no name may have: choose another name
file-there-is-no-such-example = There is no such example
file-the-examples-are = The examples are in the File menu
file-opened = opened
file-expected-the-name = expected the name of a file, in UTF-8
file-exists-already-allow-replacing-it-or = { $there } exists already; allow replacing it, or choose another name
file-was-not-written = { $path } was not written
file-what-was-there-before = What was there before is there still
file-read = read
file-checking-samples = checking { $samples } samples
file-could-not-be-nothing-was = { $name } could not be { $done }; nothing was changed
file-the-system-has-no-program = the system has no program for it
file-expected-a-file-name = expected a file name that ends in .svg or .png
file-the-diagnosis-was-run = The diagnosis was run for it
file-some-letters-stand = Some letters stand in it as codes: { $says }
file-names-the-table-with-its = Names the table { $table } with its hash
file-a-table-is-not-named = A table is not named in it: { $because }
file-could-not-be-saved = { $path } could not be saved

## dialog

dialog-open-session-model-or-measurements = Open session, model or measurements
dialog-sessions-and-models-json = Sessions and models (*.json)
dialog-all-files = All files
dialog-targets-or-program-to-correct = Targets or program to correct
dialog-import-measurements = Import measurements
dialog-where-the-robot-was-sent = Where the robot was sent
dialog-points-known-in-the-base = Points known in the base frame
dialog-reflectors-in-the-tool-frame = Reflectors in the tool frame
dialog-robots-and-sessions-json-urdf = Robots and sessions (*.json, *.urdf, *.xml)
dialog-tables-csv-txt-tsv-dat = Tables (*.csv, *.txt, *.tsv, *.dat, *.asc)
dialog-measurements-csv-txt-tsv-dat = Measurements (*.csv, *.txt, *.tsv, *.dat, *.asc)
dialog-session-json = Session (*.json)
dialog-html-or-pdf-html-pdf = HTML or PDF (*.html, *.pdf)
dialog-pdf = PDF (*.pdf)
dialog-svg-or-png-picture = SVG or PNG picture (*.svg, *.png)
dialog-model-json = Model (*.json)
dialog-csv-table-csv = CSV table (*.csv)
dialog-targets = Targets
dialog-folder-with-the-sessions = Folder with the sessions of a machine
dialog-logo-of-the-report = Logo of the report
dialog-png-pictures = PNG pictures

## running

running-cancelling = cancelling

## gestures

gestures-wheel-or-pinch = wheel, or pinch
gestures-zoom-at-the-pointer = zoom at the pointer
gestures-shift-and-wheel = Shift and wheel
gestures-zoom-along-a-charts-axis = zoom along a chart's axis
gestures-drag = drag
gestures-move = move
gestures-drag-with-the-right-button = drag with the right button
gestures-show-a-part = show a part
gestures-drag-in-the-3-d = drag in the 3-D view
gestures-orbit = orbit
gestures-shift-or-middle-button = Shift or middle button and drag in the 3-D view
gestures-double-click-or-home = double click, or Home
gestures-fit-the-view = fit the view

## legend

legend-show = show { $name }
legend-leave-it-out-so = Leave it out, so that what is left can be seen
legend-show-it-as-well = Show it as well
legend-as-measured = as measured
legend-legend = legend
legend-nominal-path = nominal path
legend-over-the-ranges = poses over the joints’ ranges
legend-nominal-circle = nominal circle
legend-mean-before = mean before
legend-mean-after = mean after
legend-from-the-smallest = from the smallest to the largest at each angle

## plots

plots-save-picture = Save picture of the { $plot }…
plot-workspace = workspace
plot-3-D-view = 3-D view
plot-polar = polar
plot-deviation = deviation
plot-deviation-over-time = deviation over time
plot-deviation-over-load = deviation over load
plot-deviation-over-temperature = deviation over temperature
plot-deviation-by-joint = deviation by joint
plot-order-spectrum = order spectrum
plot-histogram = histogram
plot-normal-quantiles = normal quantiles
plot-gap-by-step = gap by step
plot-effect-s-curve = effect's curve
plot-correction-table = correction table

## camera

camera-isometric = isometric
camera-top = top
camera-front = front
camera-side = side
camera-view = { $view } view
camera-seen-from-azimuth-elevation = seen from azimuth { $azimuth }°, elevation { $elevation }°

## looking

looking-before-and-after = before and after
looking-uncertainty = uncertainty (1σ)

## message

message-saved = Saved { $name }
message-there-is-nothing-to-search = There is nothing to search yet
message-open-a-session-that-was = Open a session that was measured on this robot
message-the-model-from-a-file = the model from a file
message-the-identification-by-region = the identification by region
message-identified-with-the-full-model = Identified with the full model in place of { $before }
message-the-diagnosis-starts = The diagnosis starts from the full model; undo brings the other back
message-identifying = identifying, { $samples }
message-preparing-the-table = preparing the table
message-drawing = drawing
message-waiting-for-a-file = waiting for a file to be chosen
message-waiting-for-a-file-name = waiting for a file name
message-could-not-be-opened = { $path } could not be opened
message-something-went-wrong-inside = Something went wrong inside the program
message-nothing-was-changed-save-your = Nothing was changed; save your work, and please report what you did last
message-no-file-was-chosen = No file was chosen
message-if-no-dialog-appeared-drop = If no dialog appeared, drop the file on the window, or type its path in the Session step
message-there-is-no-model = There is no model to correct targets by
message-identify-the-robot-first-or = Identify the robot first, or open a model
message-correcting-the-targets = correcting the targets of { $name }
message-there-are-no-corrected-targets = There are no corrected targets yet
message-choose-a-table-of-targets = Choose a table of targets or a robot program first
message-writing = writing { $path }
message-this-change-cannot-be-made = This change cannot be made
message-regions-divide-what-was-measured = regions divide what was measured with a single joint that turns
message-looking-where-regions-are-needed = looking where regions are needed
message-there-is-no-measuring-list = There is no measuring list yet
message-run-the-diagnosis-first = Run the diagnosis first
message-there-is-nothing-to-export = There is nothing to export yet
message-there-is-no-file = There is no file to follow
message-the-samples-of-this-session = The samples of this session are not in a file of their own
message-the-file-was-rewritten = The file was rewritten and is read anew
message-what-was-read-before = What was read before is here still; mend the file, then follow it again
message-the-file-cannot-be-followed = The file cannot be followed any further
message-looking-at-the-file = looking at the file
message-the-window-closes-after = The window closes after { $what }
message-reading = reading { $path }
message-reading-an-example = reading an example
message-simulating = simulating
message-saving = saving { $path }
message-there-is-no-session = There is no session to save
message-a-model-by-itself = A model by itself is saved in the Export step
message-there-is-nothing-to-report = There is nothing to report yet
message-open-a-session-or-identify = Open a session, or identify the robot first
message-the-figures-could-not-be = The figures could not be worked out
message-restored-it-is-not-saved = Restored; it is not saved yet
message-what-was-left-behind = What was left behind is damaged and cannot be restored
message-it-is-kept-as = It is kept as { $aside }
message-preferences-could-not-be-read = Preferences could not be read: { $says }
message-what-is-not-saved-cannot = What is not saved cannot be kept against a crash: { $home }: { $error }
message-not-everything-could-be-set = Not everything could be set up
message-not-everything-could-be-kept = Not everything could be kept for tomorrow
message-the-session-is-as = The session is as it was; save it under a name of your own
message-waiting-for-a-folder = waiting for a folder to be chosen
message-comparing-the-sessions = comparing the sessions of { $folder }
message-there-are-no-sessions = There are no sessions to compare
message-nothing-can-be-recorded = Nothing can be recorded
message-recorded = Recorded { $path }: { $says }
message-the-recording-ended = The recording ended
message-what-was-recorded-before = What was recorded before is in the file

## view

view-regions = Regions
view-diagnose = Diagnose

## chart

chart-component = Component
chart-joint-of-the-chart = Joint of the chart
chart-fit-chart-to-view = Fit chart to view
chart-computing = Computing…

## compensate

compensate-compensate = Compensate…
compensate-a-table-of-targets-csv = A table of targets (CSV), RAPID, KRL, URScript or FANUC LS: its targets are corrected in place, and what changes is shown before anything is saved

## copies

copies-copied = Copied
copies-copy = Copy
copies-table = { $says } table of { $of }
copies-copy-numbers = Copy numbers: { $of }

## coverage

coverage-rms-error-of-the-nominal = RMS error of the nominal robot
coverage-largest-deviation = largest deviation
coverage-of = { $inside } of { $all }
coverage-instrument = { $floor }, instrument
coverage-not-identified-yet-the-identified = Not identified yet. The identified parameters will stand here, with the interval of every number
coverage-what-the-samples-cover = What the samples cover
coverage-measured-range = measured range
coverage-widest-hole = widest hole
coverage-not-recorded = not recorded
coverage-took = took
coverage-throughout = { $decimals } { $unit } throughout
coverage-samples-over-the-range = samples over the range of joint 1
coverage-samples-over-the-range-of-joint = Samples over the range of joint 1: where it is empty nothing is known
coverage-testable-effects = Testable effects
coverage-can-be-tested = { $yes } can be tested
coverage-cannot-and-why = { $no } cannot, and why
coverage-no-diagnosis-yet = No diagnosis yet
coverage-effects-that-are-found-will = Effects that are found will be listed here with size, confidence and what to check on the machine. Where the samples cannot decide, both are listed, with the poses that would decide
coverage-it-takes-a-moment = It takes a moment, and some seconds with a million samples. The window stays free meanwhile, and the search can be stopped
coverage-nothing-to-export-yet = Nothing to export yet
coverage-the-table-comes = The table comes from the identified robot. It will stand here as text, with its sign convention in words, the RMS error that it leaves, and what joint commands cannot correct
coverage-below-none-above = { $up } below, none above
coverage-none-below-above = none below, { $down } above
coverage-below-above = { $up } below, { $down } above
coverage-standstill = standstill
coverage-throughout-2 = { $speed } throughout
coverage-up = up to { $speed }
coverage-came-from = came from
coverage-came-from-joint = came from, joint { $joint }
coverage-speed = speed
coverage-speed-joint = speed, joint { $joint }

## disk

disk-was-changed-by-another-program = { $name } was changed by another program
disk-reload-reads-it-again-undo = Reload reads it again; undo brings back what is here now. If you keep this version, you will be asked before overwriting
disk-what-was-read-is-here = What was read is here still: saving writes it again, or put the file back
disk-keep-this = Keep this
disk-reload = Reload
disk-save-it-again = Save it again
disk-save-it-again-2 = Save it again…

## dropped

dropped-drop-the-file-to-open = Drop the file to open it

## export

export-there-is-nothing-to-export = There is nothing to export yet: the table comes from the identified robot
export-found-but-not = Found, but not in the model, so not corrected: { $names }
export-add-it-to-the-model = Add it to the model
export-add-all-to-the-model = Add all { $n } to the model
export-report = Report
export-html-or-pdf-what-was = HTML or PDF: what was measured, what the search found, what stays open
export-html-or-pdf-the-session = HTML or PDF: the session is searched for it first, which takes a while
export-report-of-the-model = Report of the model…
export-format = Format
export-the-table-is-being-prepared = The table is being prepared
export-entries = entries
export-also = Also
export-copy-text = Copy text
export-custom-step = Custom step
export-rms-error-to-this-robot = RMS error to this robot
export-rms-error-left = RMS error left by the table
export-not-correctable-by-joint-commands = Not correctable by joint commands
export-over-the-samples-noise = Over the samples: noise, and loads and warmth that no table knows, are in it; what the model by itself promises stands below
export-model-and-measurement = model and measurement
export-the-model-says-that-more = The model says that more stays than was measured: it is not the robot
export-what-the-numbers-mean = What the numbers mean
export-and-more-lines = and { $more } more lines
export-go-to-identify = Go to identify
export-save-as = Save { $what } as .{ $title }…
export-without-it = without it

## found

found-p-chance-that-noise-alone = p { $sign } { $p } (chance that noise alone looks like this)
found-more-than-1000 = More than 1000
found-times-likelier-than-the-next = { $odds } times likelier than the next candidate, { $next }
found-cross-validated-rms-error = cross-validated RMS error
found-what-to-check = What to check
found-add-to-model = Add to model
found-in-the-model = in the model
found-mend-all = Mend all { $mends }

## limits

limits-detection-limits-95 = Detection limits: { $number } (95 %)
limits-detection-limits = detection limits
limits-not-testable = Not testable: { $not_testable }

## diagnosis

diagnosis-diagnosis = Diagnosis
diagnosis-nothing-found-so-far = Nothing found so far
diagnosis-found-so-far-a-likelier = Found so far; a likelier name may take the place of one
diagnosis-diagnosis-is-running = Diagnosis is running
diagnosis-it-had-found-nothing-until = It had found nothing until then
diagnosis-found-until-then-not-yet = Found until then, not yet tested against other names: run the diagnosis again to test them
diagnosis-diagnosis-stopped = Diagnosis stopped
diagnosis-found-effects = found effects
diagnosis-nothing-is-missing = Nothing is missing
diagnosis-explained-the-remaining-error = Explained: the remaining error is at the noise floor
diagnosis-partly-explained-an-error = Partly explained: an error is left without a name
diagnosis-not-explained-by-any-effect = Not explained by any effect
diagnosis-from-repeats = from repeats
diagnosis-of-the-instrument = of the instrument
diagnosis-these-samples-can-show-no = these samples can show no effect: that nothing was found says nothing
diagnosis-the-samples-also-allow-another = the samples also allow another explanation, see below
diagnosis-held-out = Held out: { $how }
diagnosis-noise-stated = noise σ, stated
diagnosis-noise-as-found = noise σ, as found
diagnosis-slow-noise = Slow noise: { $slow }
diagnosis-the-samples-cannot-rule-out = The samples cannot rule out
diagnosis-instead = { $instead } instead of { $explanation }
diagnosis-1-against = { $odds } : 1 against it. { $separate_by }
diagnosis-excluded-by-hand = Excluded by hand
diagnosis-excluded-outliers = Excluded outliers: { $excluded } of { $all }
diagnosis-and-more = and { $more } more

## next

next-measure-these-poses-next = Measure these poses next
next-second-time-the-same-pose = Second time: the same pose again, after another one, as once is not enough over the noise
next-and-more-in-the-measuring = and { $more } more, in the measuring list
next-poses = poses
next-save-measuring-list = Save measuring list…

## diagnose

diagnose-open-a-session-that-was = Open a session that was measured on this robot first
diagnose-looks-for-the-physical-effect = Looks for the physical effect that the model lacks, and proves each name on samples that the search has not seen
diagnose-nominal-robot = nominal robot
diagnose-with-found-effects = with found effects
diagnose-run-diagnosis-again = Run diagnosis again
diagnose-rms-error-so-far = RMS error so far
diagnose-the-diagnosis-identifies-by-itself = The diagnosis identifies by itself: Identify need not come first
diagnose-little-error-is-left-above = Little error is left above the instrument's noise. The diagnosis says where nothing is missing, with the detection limits
diagnose-more-error-is-left-than = More error is left than noise explains, or no noise is stated: the diagnosis will tell which
diagnose-the-diagnosis-starts = The diagnosis starts from the full model, which takes the place of what is identified now. Undo brings that back
diagnose-what-it-can-find = What it can find
diagnose-why-the-others-are-not = Why the others are not testable is listed at the right, with what to measure for them
diagnose-diagnosing = Diagnosing
diagnose-found-so-far = found so far
diagnose-so-far-a-likelier-name = so far; a likelier name may take the place of one
diagnose-in-the-model = In the model
diagnose-use = use { $effect }
diagnose-one-effect-in-the-model = one effect in the model
diagnose-effects-in-the-model = { $on } effects in the model
diagnose-nothing-is-missing = nothing is missing
diagnose-something-unexplained = something unexplained
diagnose-one-effect-found = one effect found
diagnose-effects-found = { $n } effects found
diagnose-stop-the-search = Stop the search

## grips

grips-steps = steps
grips-results = results

## identify

identify-model-from-a-file = model from a file
identify-by-region = by region
identify-parameters = full model, { $count } parameters
identify-with-the-full-model = full model
identify-the-model-in-takes = The model in { $given } takes the place of an identification
identify-to-identify-the-robot-anew = To identify the robot anew, open a session that was measured on it
identify-identify-from-this-session = Identify from this session
identify-method = Method
identify-full-model = Full model
identify-by-region-2 = By region
identify-one-model-for-the-whole = One model for the whole range, fitted in the measuring frame, with an interval for every number
identify-the-source-papers-method = The source paper's method: a constant correction of angle and radius for each region. It leaves out the rotation between lamp and base, so that one constant error looks different in every region; use it to compare with earlier reports
identify-change-the-regions = Change the regions
identify-effects-to-fit = Effects to fit
identify-that-this-session-cannot-show = { $not_testable } that this session cannot show
identify-identified-the-result-follows-every = Identified; the result follows every change
identify-continue-to-diagnose = Continue to diagnose

## menu

menu-examples = Examples
menu-not-there-any-more = not there any more
menu-standard-3-d-views = Standard 3-D views
menu-larger = Larger
menu-smaller = Smaller
menu-usual-size = Usual size
menu-file = File
menu-edit = Edit
menu-view = View
menu-help = Help
menu-nothing-to-redo = Nothing to redo
menu-redo = Redo { $what }
menu-nothing-to-undo = Nothing to undo
menu-undo = Undo { $what }
menu-example = example
menu-simulated = simulated
menu-restored = restored
menu-from = from { $path }
menu-model = model { $origin }
menu-model-2 = { $origin } · model { $given }
menu-not-saved = { $origin } · not saved

## model

model-model-from-a-file = Model from a file
model-file = file
model-identified = identified from
model-measured = measured, { $joint }
model-nothing-was-measured-yet-open = Nothing was measured yet. Open a session that was measured on this robot, and what the model does there will stand here
model-how-it-came-about = How it came about
model-held-out = { $gap }, held out { $held_out }
model-held-against-this-session = Held against this session
model-measured-and-model = measured and model
model-with-corrected-commands = with corrected commands
model-largest-then = largest then
model-the-largest-deviations-among-them = , the largest deviations among them
model-of-samples = { $drawn } of { $samples } samples{ $largest }

## names

names-and = {" "}and{" "}
names-not-identifiable = Not identifiable
names-show-its-curve = Show its curve

## pictures

pictures-there-is-no-such-chart = there is no such chart
pictures-the-deviation-around-the-angle = the deviation around the angle
pictures-measured-points-deviations-magnified-times = measured points, deviations magnified { $magnification } times

## regions

regions-from-to-and-where = { $regions } from { $low } to { $high }, and where the samples are
regions-region = region { $name }, { $from } … { $to }: { $samples }
regions-in-no-region = in no region
regions-optional = optional
regions-optional-2 = optional, { $regions }
regions-regions-divide-what-was-measured = Regions divide what was measured: open a session that was measured on this robot
regions-uniform = Uniform
regions-manual = Manual
regions-adaptive = Adaptive
regions-drag-a-boundary = Drag a boundary on the plot, or type it; the identification follows at once
regions-region-2 = {" "}region
regions-regions = {" "}regions
regions-number-of-regions = Number of regions
regions-divide = Divide
regions-reset-to-session = Reset to session
regions-take-the-regions = take the regions that the session brings along
regions-there-are-no-regions-nothing = There are no regions: nothing is corrected by region. Divide the range evenly, or where the data ask for it
regions-there-are-no-regions-because = There are no regions, because all samples are at one angle: there is no range to divide. Give the joint its limits in Session, or measure at other angles. The full model in Identify needs no regions
regions-and-more = { $gap } and { $n } more
regions-in-no-region-and-no = { $more }: in no region, and no sample is there
regions-in-no-region-1-sample = { $more }: in no region; 1 sample there gets no correction
regions-in-no-region-samples-there = { $more }: in no region; { $n } samples there get no correction
regions-sample = sample is
regions-samples-are = samples are
regions-in-no-region-and-get = { $outside } { $samples } in no region and get no correction
regions-optional-fills-the-next-step = Optional: fills the next step, Identify, region by region
regions-identify-by-region = Identify by region
regions-split-in-half = Split in half
regions-it-is-too-narrow = it is too narrow
regions-merge-with-previous = Merge with previous
regions-merge-with-next = Merge with next
regions-no-region-touches = no region touches it
regions-delete = Delete
regions-the-last-region-stays = the last region stays
regions-rename = Rename
regions-change-region = Change region { $name }
regions-with-the-focus-here-s = with the focus here: S splits, M merges, Del deletes, R renames
regions-and-more-to-be-dragged = and { $more } more, to be dragged on the plot
regions-name = name
regions-from = from, { $unit }
regions-to = to, { $unit }
regions-no-sample-so-no-correction = no sample, so no correction: measure here, or merge it with the next
regions-none-of-which-can-be = { $measured }, none of which can be fitted, so no correction
regions-one-sample-to-fit = one sample to fit: a correction, but nothing to tell how sure it is
regions-name-of-region = Name of region { $name }
regions-region-3 = { $end }, region { $region }
regions-from-2 = From
regions-to-2 = To
regions-until-then-it-stays = { $which }{ $says }. Until then it stays at { $stays }
regions-show-the-sample-of-region = Show the sample of region { $region }
regions-show-the-of-region = Show the { $samples } of region { $region }
regions-region-from = Region { $region }, from:{" "}
regions-region-to = Region { $region }, to:{" "}

## results

results-summary = Summary
results-samples = Samples
results-this-could-not-be-identified = This could not be identified
results-rms-error-by-region = RMS error, by region
results-rms-error-model = RMS error, model from a file
results-rms-error-full-model = RMS error, full model
results-largest = largest
results-of = { $before } → { $after } of { $all }
results-identified-parameters = Identified parameters
results-half-the-95-interval = ± half the 95 % interval
results-parameters = parameters
results-correction-of-each-region = Correction of each region
results-was = was { $rms_before }
results-what-to-add = What to add
results-what-to-add-half = What to add, ± half the 95 % interval
results-measurement-noise = measurement noise: { $noise }
results-excluded-outliers-of-samples = excluded outliers: { $excluded } of { $all } samples
results-sample-is-an-outlier = sample { $sample } is an outlier: { $deviation } from the model
results-sample-is-excluded = sample { $sample } is excluded: { $because }
results-and-more = and { $more } more
results-notes = Notes
results-region = region
results-no-decision = No decision: { $because }

## samples

samples-sample = sample
samples-angle = angle, { $angle }
samples-before = before, { $length }
samples-after = after, { $length }
samples-largest-first = , largest first
samples-smallest-first = , smallest first
samples-column = column { $name }{ $order }
samples-excluded-by-hand-in-no = excluded by hand, in no figure
samples-row = row { $sample }, { $what }
samples-within-the-tolerance = within the tolerance
samples-outside-the-tolerance = outside the tolerance

## session

session-a-model-nothing-measured = a model, nothing measured
session-measured = Measured
session-another-session-or-model = Another session or model
session-none-this-is-a-model = none: this is a model
session-reflectors = reflectors
session-not-given = not given
session-noise-one = noise, one σ
session-coordinates = coordinates
session-x-and-y-z-was = x and y; z was not measured
session-compensated = compensated
session-yes-this-shows-what = yes: this shows what is left
session-new-lines-are-read-as = New lines are read as they are written, and the answer follows
session-came-since = { $samples } came since
session-import-log = Import log: { $count }
session-note = note
session-warning = warning
session-error = error
session-type-a-path-or-drop = type a path, or drop a file
session-path-of-a-session-or = Path of a session or model
session-this-is-an-example = This is an example that comes with the program
session-continue-to-regions = Continue to regions

## standards

standards-accuracy-and-repeatability = Accuracy and repeatability
standards-the-figures-are-being-worked = The figures are being worked out
standards-figures = figures
standards-missing = missing: { $line }
standards-from-below-from-above = ↑ from below, ↓ from above
standards-measured = measured, { $group }

## status

status-model-of-open-a-session = model of { $robot } · open a session measured on this robot to see what the model does
status-rms-error = RMS error { $gaps } { $unit }
status-rms-error-2 = RMS error { $rms } { $unit }
status-no-sample-can-be-used = no sample can be used
status-floor = {" "}· floor { $floor } { $unit } ({ $from })
status-repeats = repeats
status-identify-again = Identify again
status-the-identification-was-cancelled = the identification was cancelled
status-stop-following = Stop following
status-following-the-file-new = following the file · { $came } new
status-understood = Understood

## toast

toast-show-in-folder = Show in folder

## details

details-report-details = Report details
details-stated-at-the-head = Stated at the head of the report, and remembered for this machine; what is empty is a line to fill in by hand
details-such-as-a-date = such as 22 Nov 2026
details-field-report_number = Report number
details-field-date = Date
details-field-customer = Customer
details-field-machine = Machine
details-field-machine_serial = Serial number of the machine
details-field-instrument = Instrument
details-field-instrument_serial = Serial number of the instrument
details-field-instrument_calibrated = Instrument calibrated on
details-field-operator = Operator
details-logo = Logo
details-a-png-file = a PNG file
details-history = History of the machine
details-compare-the-sessions = Compare the sessions of this robot in the folder of the session
details-save-the-session-first = The session is in no folder yet: save it first
details-logo-cannot-be-used = Logo { $found }; expected { $expected }
details-pass-or-fail = Pass or fail
details-last-time-it-was = Last time it was { $last } mm
details-use-it = Use it
details-decision-rule = Decision rule
details-not-decided = not decided
details-simple-acceptance = simple acceptance
details-the-reader-decides = The report states the errors and leaves the decision to its reader
details-pass-with-its-uncertainty = Pass where the largest deviation and its uncertainty together are within the tolerance, fail where the deviation without its uncertainty is above it; between them neither is proven
details-pass-without-its-uncertainty = Pass where the largest deviation is within the tolerance; the uncertainty is stated and does not count (JCGM 106, 8.2)

## history

history-of = History of { $robot }
history-of-the-folder-by-time = Sessions and models of the folder { $folder }, by the time of the first sample
history-of-the-folder-by-name = Sessions and models of the folder { $folder }, by file name, numbers in it by their value
history-robot = Robot
history-all-sessions = All sessions
history-before-and-after = Before and after
history-before = Before
history-after = After
history-is-excluded = { $file } is excluded: { $because }
history-other-folder = Other folder…
history-errors = Errors
history-parameters = Parameters
history-no-parameter-was-identified = No parameter was identified
history-half-the-95-interval = ± half the 95 % interval; { $mark } changed by more than its interval
history-the-last-sessions = ; the last { $shown } of { $all } sessions
history-over-the-sessions = { $parameter } over the sessions
history-no-parameter-in-common = They have no parameter in common
history-parameters-changed = { $changed } of { $all } parameters changed by more than the 95 % interval of the difference
history-errors-before = Before: RMS error { $nominal } nominal, { $identified } after identification
history-errors-after = After: RMS error { $nominal } nominal, { $identified } after identification
history-changed-of = { $changed } of { $all }
history-heading-session = Session
history-heading-from = From
history-heading-samples = Samples
history-heading-rms-error-nominal-mm = RMS error nominal, mm
history-heading-model-mm = Model, mm
history-heading-with-the-earliest-mm = With the earliest, mm
history-heading-changed = Changed
history-heading-parameter = Parameter
history-heading-unit = Unit
history-heading-before = Before
history-heading-after = After
history-heading-difference = Difference
history-heading-beyond-its-interval = Beyond its interval
history-cell-session = session
history-cell-model = model
history-cell-not-determined = not determined
history-cell-changed = changed
history-cell-no = no

## recording

recording-record-from-instrument = Record from instrument
recording-lines-of-text-become = Lines of text, one for each measurement, become samples of a new session of { $robot }; a connection that ends is made again
recording-address = Address
recording-address-forms = tcp://HOST:PORT or udp://:PORT
recording-columns = Columns
recording-empty-the-first-line = empty: the first line names them
recording-file = File
recording-a-new-csv-table = a new CSV table
recording-type-where-it-sends = Type where the instrument's software sends, such as tcp://192.168.0.10:4000
recording-columns-such-as = Columns such as q1_deg, x_mm, y_mm, z_mm; between commas, semicolons, tabs or spaces
recording-a-name-that-ends-in-csv = { $path }: expected a name that ends in .csv
recording-the-folder-is-not-there = { $folder }: the folder is not there
recording-exists-already = { $path } exists already: nothing is replaced by a recording
recording-record = Record
recording-stop = Stop recording
recording-left-out-last = Left out last: { $line }
recording-stands = recording · { $lines }{ $left_out } · { $state }
recording-lines =
    { $count ->
        [one] { $count } line
       *[other] { $count } lines
    }
recording-left-out = {" "}· { $count } left out
recording-connecting = connecting
recording-connected = connected
recording-not-connected = not connected, tries again: { $why }

## unexplained

unexplained-unexplained = Unexplained
unexplained-what-is-left = what is left
unexplained-where = where
unexplained-a-part-of-it-looks = A part of it looks like { $resembles }
unexplained-it-cannot-be-corrected = It cannot be corrected: { $because }
unexplained-cross-validated-rms-error-corrected = cross-validated RMS error, corrected
unexplained-add-smooth-correction = Add smooth correction
unexplained-smooth-correction-in-the-model = smooth correction in the model
unexplained-largest-along-the-motion = largest along the motion
unexplained-largest-along-the-radius = largest along the radius
unexplained-largest-along-the-axis = largest along the axis
unexplained-a-smooth-curve-without = A smooth curve without a name. Outside the measured range its end values are held, and nothing is known

## fields

fields-the-value-is-kept = { $because }; the value is kept
fields-or-none = {""}, or none

## grip

grip-width = width of { $name }

## text

text-usually = usually { $usual_size }
text-size-from-to = { $from } to { $to }
text-what-means = what { $word } means

## sample

sample-before-after = before → after
sample-moving-negative = moving negative
sample-not-known = not known
sample-approached = approached
sample-a-value-is-missing = a value is missing
sample-click-for-more = click for more
sample-card = card of { $title }: { $parts }

## handles

handles-boundary = boundary at { $at }°
handles-drag-or-press-the-arrow = drag, or press the arrow keys; shift takes larger steps
handles-no-samples = { $name }: no samples
handles-l1-left = { $name }: { $samples }, Δθ { $theta }, Δl1 { $l1 }, left { $left }

## layout

layout-this-computer-draws-in-software = this computer draws in software
layout-zoom-in-for-more = zoom in for more
layout-1 = 1 of { $one_of } { $what }: { $why }
layout-points = points

## paint

paint-workspace-plot-samples = workspace plot, { $samples } samples

## polar

polar-nothing-was-measured-yet = Nothing was measured yet: the polar view shows deviations around the joint’s angle
polar-this-robot-has-several-joints = This robot has several joints, so that a deviation belongs to no single angle: there is no polar view. The other views show where it is, the chart below over which value of the first joint
polar-this-joint-slides = This joint slides, and a length does not close a circle: there is no polar view. The chart below shows the deviation along the joint’s way
polar-1-division = 1 division = { $length } { $unit }
polar-polar-view-samples = polar view, { $component }, { $samples } samples, { $polar }
polar-deviation-around-the-angle = { $component } deviation around the angle
polar-1-division-mm-the-thick = 1 division = { $division } mm; the thick circle is nominal
polar-outline-before = outline: before
polar-outline-before-filled-after = outline: before, filled: after
polar-filled-after = filled: after
polar-tip-up-moving-positive-tip = ; tip up: moving positive, tip down: negative
polar-dashed-tolerance-mm = ; dashed: tolerance { $tolerance } mm
polar-1-of-samples = ; 1 of { $stride } samples

## robot

robot-robot-at-sample = robot at sample { $sample }
robot-robot-at-sample-as = robot at sample { $sample }, as an example
robot-robot-as-posed = robot as posed
robot-robot-at-home = robot at home
robot-and-more = and { $more } more

## scales

scales-legend = legend: { $name }

## pose

pose-pose = Pose
pose-back-to-sample = Back to sample
pose-pose-of-joint = Pose of joint { $k }, { $joint }
pose-from-the-sample = from the sample that is shown

## space

space-3-d-view-samples = 3-D view, { $samples } samples, { $camera }
space-sample-selected = , sample { $sample } selected
space-arrow-keys-orbit-plus = arrow keys orbit, plus and minus zoom, Home fits; 0, 1, 3 and 7 are standard views
space-grid = grid { $square } { $unit }
space-tool = tool
space-samples-deviations-magnified-times = { $session }: { $samples } samples, { $camera }, deviations { $state } magnified { $magnified } times
space-grid-mm = grid { $square } mm
space-colour = ; colour: { $colouring }
space-base = base

## toolbar

toolbar-fit-to-view = Fit to view
toolbar-how-it-is-drawn = How it is drawn
toolbar-drawn = drawn
toolbar-vectors = vectors × { $now }
toolbar-length-of-vectors = Length of vectors
toolbar-3-d = 3-D
toolbar-polar = polar
toolbar-colour = colour
toolbar-component-of-the-polar-view = Component of the polar view
toolbar-both = both
toolbar-only-after = only after
toolbar-from-before-to-after = From before to after
toolbar-shown-the-deviation-before-measured = shown: the deviation before, measured − nominal robot
toolbar-shown-what-is-left-after = shown: what is left after, measured − identified robot
toolbar-shown-of-the-way = shown: { $percent } % of the way from before to after
toolbar-how-long-vectors-are-drawn = how long vectors are drawn and where the colours of lengths end: so that the deviations before can be read, or those that are left after
toolbar-scale = scale for
toolbar-free = free
toolbar-standard-view = Standard view
toolbar-pose = pose
toolbar-sliders-that-pose-the-robot = sliders that pose the robot
toolbar-pose-the-robot = Pose the robot
toolbar-the-root-mean-square-deviation = the root mean square deviation between the samples, fading away from them
toolbar-colour-of-vectors = Colour of vectors
toolbar-from = from

## chart words

chart-word-before = before
chart-word-after = after
chart-word-as-measured = As measured
chart-word-against-the-model = Against the model
chart-word-moving-positive = moving positive
chart-word-negative = negative
chart-word-tolerance = tolerance
chart-word-noise-floor = noise floor
chart-word-cross-validated = cross-validated
chart-word-on-samples-that-no-fit-has-seen = on samples that no fit has seen
chart-word-the-gap-step-by-step = the gap step by step
chart-word-rms-error = RMS error
chart-word-nominal-robot = nominal robot
chart-word-geometry = geometry
chart-word-exact-identification = full model
chart-word-full-model = full model
chart-word-by-region = by region
chart-word-value-95-interval = value, 95 % interval
chart-word-changed = changed
chart-word-by-the-time-of-the-first-sample = by the time of the first sample
chart-word-by-file-name-numbers-in-it-by-their-value = by file name, numbers in it by their value

## scale

scale-point = point
scale-entry = entry
scale-every-shown = every { $stride }{ $ordinal } { $what } shown

## examples

example-lamp = Lamp commissioning
example-lamp-what = two reflectors, both sides, noise, while the machine warms up
example-samples = The paper's 30 samples
example-samples-what = six regions of five samples, without noise
example-run = The paper's full run
example-run-what = 361 samples, every half degree

## effects

effect-on-joint = { $effect }, joint { $joint }
effect-axis-tilt = Axis tilt
effect-axis-wobble = Axis wobble
effect-backlash = Backlash
effect-base-offset = Base offset
effect-bearing-runout = Bearing runout
effect-encoder-eccentricity = Encoder eccentricity
effect-encoder-two-cycle = Encoder two-cycle error
effect-foundation-compliance = Foundation compliance
effect-frame-drift = Frame drift
effect-frame-shift = Frame shift
effect-gear-transmission-error = Gear transmission error
effect-instrument-scale = Instrument scale
effect-joint-compliance = Joint compliance
effect-joint-scale = Joint scale
effect-joint-zero-offset = Joint zero offset
effect-link-droop = Link droop
effect-link-geometry = Link geometry
effect-link-length = Link length
effect-lost-motion = Lost motion
effect-measuring-frame = Measuring frame
effect-screw-pitch = Screw pitch error
effect-thermal-growth = Thermal growth
effect-thermal-zero-drift = Thermal zero drift
effect-tool-lateral-offset = Tool lateral offset
effect-tool-orientation = Tool orientation
effect-tool-position = Tool position
effect-tracking-lag = Tracking lag
effect-unexplained-directions = Directions of what is unexplained
effect-unknown-anchor = Anchor
effect-unknown-plane = Plane
effect-unknown-socket = Socket
effect-unknown-station = Station
effect-wrist-coupling = Wrist coupling

## glossary words

word-deviation = Deviation
word-deviation-means = Where the reflector was measured, minus where the simulation says it should be
word-gap = RMS error
word-gap-means = Root mean square of the length of the deviation over all samples. Suspected outliers do not count in it, but they do in the largest deviation
word-largest = Largest deviation
word-largest-means = The one sample that is furthest off, suspected outliers included
word-tolerance = Tolerance
word-tolerance-means = How far a measured position may be off. Samples within it are marked with a disc, those outside with a diamond
word-noise = Noise, one σ
word-noise-means = How much the instrument's own reading scatters along one axis, as its maker or a repeatability check says. Two of three readings are nearer than this. Without it, it is estimated from the samples
word-floor = Noise floor
word-floor-means = The RMS error of a perfect model: the scatter of repeated poses, or of the instrument. No model can come below it, and one that comes close has nothing left to explain
word-interval = Interval, ±
word-interval-means = The true value lies within it in 19 of 20 calibrations like this one. It shrinks with more samples and with poses that differ more
word-held-out = Held out
word-held-out-means = Samples that no fit has seen. The model has to predict them: an RMS error that falls there too is proof, one that falls only on the others is chance
word-p-family = By chance
word-p-family-means = How often noise alone would make some name of the whole list look at least this good. 1 of 2000 is hard evidence, 1 of 20 is not
word-odds = Odds over the next candidate
word-odds-means = How many times more likely this name is than the next best one, given the samples. Below about 20 : 1 both stay possible, and the poses that would decide are listed
word-share = Share
word-share-means = Which part of what the identification left over this name explains
word-unexplained = Unexplained
word-unexplained-means = Something regular is left that no name of the list fits. It is shown where it is, so that somebody can look there
word-limit = Detection limit
word-limit-means = The smallest size of an effect that these samples would have shown. What was not found is smaller than this, not necessarily nothing
word-region = Region
word-region-means = A range of the joint that gets a constant correction of its own, as older controllers want it
word-correction = Correction
word-correction-means = What to add to the command or the position: the deviation with the opposite sign
word-exact = Full model
word-exact-means = One model for the whole range: all parameters at once, in the frame of the instrument
word-outlier = Suspected outlier
word-outlier-means = A sample so far from the model that it is at least four times likelier to be a mistake of the measurement than noise. It is excluded from the fit, stays on the screen, and is worth measuring again
word-slow-noise = Slow noise
word-slow-noise-means = A part of the error that wanders in time, whatever the robot does: a tripod that settles, air, a tracker that warms up. The intervals allow for it, and no effect of the robot is read into it
word-not-identifiable = Not identifiable
word-not-identifiable-means = Two causes that do the same to every sample measured so far. Poses that differ more, a second reflector, or both directions usually tell them apart
word-targets = Compensated targets
word-targets-means = Targets of a table or a program whose numbers were changed, so that the real tool goes where the nominal robot would. A target that is singular, beyond the limits or ambiguous is named and left as it is
word-predicted = Position error, as the model predicts it
word-predicted-means = How far the real tool, as the model knows it, is from the targets of the file: with their numbers as they are, and with the corrected ones
word-language = Read as
word-language-means = The language of the file, by its ending, else by what it looks like
word-remainder = Not correctable by joint commands
word-remainder-means = RMS error that remains when the controller applies the whole table: directions in which moving this joint moves nothing
word-uncertainty = Uncertainty of the model
word-uncertainty-means = How far the point that the model predicts may be off because measurements scatter: one standard uncertainty, from the covariance of the fit, at each measured pose, and of several joints at poses over their ranges. It is small where many poses determine the model. What no parameter of the model describes is not in it
word-planar = Planar session
word-planar-means = Only x and y were measured; nothing can be said about what happens along z
word-direction = Direction
word-direction-means = The side from which the joint came to the pose. Approaching from both sides is what makes backlash visible
word-polar = Polar view
word-polar-means = A component of the deviation around the angle of the joint, as circles of a ballbar test are shown (ISO 230-4): on the nominal circle there is none, and one ring stands for the length that is written above. An oval is a tilted or wobbling axis, a shifted circle a wrong centre, two circles play between both directions
word-drawn-robot = The robot in the workspace
word-drawn-robot-means = The nominal robot in outline at the sample that is chosen or under the pointer, and beside it as a line the real one, as it was measured or identified, displaced as many times as is written beside it. Without a choice it stands faintly at a sample in the middle
word-over-time = Deviation over time
word-over-time-means = The deviation in the order in which it was measured. A slope is a drift of the machine or the tripod; a step is the moment when somebody touched one of them
word-over-load = Deviation over load
word-over-load-means = The deviation over the weight that the arm carried. A slope is an arm or a joint that gives way; it needs poses measured with different loads
word-over-temperature = Deviation over temperature
word-over-temperature-means = The deviation over the temperature that was logged. A slope is a link that grows, or a joint whose zero moves, as the machine gets warm
word-orders = Order spectrum
word-orders-means = How large the part of the deviation is that comes back once, twice, three times … with every turn of the joint. Once is an eccentric encoder or bearing, twice an oval one, and a gear shows at its number of teeth. Bars below the noise line mean nothing
word-histogram = Histogram
word-histogram-means = How many samples deviate by how much. If only noise is left, the bars fill the dashed curve; two heaps are two states, as with backlash. A click on a bar marks its samples everywhere
word-effect-curve = Effect's own curve
word-effect-curve-means = What is left when the model knows everything but this one effect, and what the effect does according to its fitted size. Where the curve runs through the points the name is right
word-setup = Setup
word-setup-means = One position of the instrument. Each has a measuring frame of its own, which is fitted
word-tool = Tool pose
word-tool-means = Position and orientation of the tool frame in the base frame when every joint is at zero
word-robot = Robot
word-robot-means = The description that the session was measured on: axes, reflectors and links as the drawing has them. Everything is measured against it
word-samples = Samples
word-samples-means = Poses that were measured. More of them, and poses that differ more, make every number surer
word-reflectors = Reflectors
word-reflectors-means = Points on the tool that the instrument sees. A second one at another radius tells causes apart that one alone cannot
word-instrument = Instrument
word-instrument-means = What the positions were measured with. Its noise is the smallest RMS error that any model can reach
word-compensated = Compensated
word-compensated-means = The commands were already corrected by a table while this was measured: what is seen here is what that table left
word-range = Measured range
word-range-means = The smallest and the largest position of the joint that was measured. Outside it nothing is known, and a table holds its end values there
word-hole = Widest hole
word-hole-means = A part of the range, much wider than the other steps, in which there is no sample. Whatever happens there stays unseen: measure a few poses in it
word-speed = Speed
word-speed-means = How fast the joint moved while it was measured. Lag behind the command shows only at different speeds
word-load = Load
word-load-means = The mass at the tool while it was measured. Bending of links and joints shows only at different loads
word-temperature = Temperature
word-temperature-means = Of the robot while it was measured. Growth with warmth shows only where it changes by some degrees
word-took = Time it took
word-took-means = From the first sample to the last. What drifts, or was knocked, shows only where samples have a time
word-shows = Testable effects
word-shows-means = How many of the physical causes that this program knows would leave a trace in these samples. What cannot be tested can be there all the same
word-without = Without it
word-without-means = RMS error of the nominal robot: what remains if nothing is corrected
word-modelled = Model and measurement
word-modelled-means = RMS error between the measurement and the identified model: what a perfect controller could reach if every direction could be corrected
word-corrected = With corrected commands
word-corrected-means = RMS error that remains on this session when the commands are corrected by the model
word-entries = Entries
word-entries-means = Lines of the table. More of them follow the curve more closely; a controller may allow only so many
word-source = Where it comes from
word-source-means = The file, and the session that the model was identified from. A model is worth what its session covers
word-place = Where
word-place-means = The part of the range, or the number of cycles per turn, at which what is left stands out: look at the machine there
word-curve = Largest of the curve
word-curve-means = The most that the smooth correction moves the point, in this direction
word-axis = Axis
word-axis-means = The line about which, or along which, a joint moves when every joint is at zero: a direction and any point on it, in the base frame
figure-a = Accuracy: from the lowest to the highest deviation anywhere on the axis, with twice the scatter on both sides
figure-a-one-way = The same for one direction of approach only: what is left where a program always comes from one side
figure-e = Systematic deviation: from the lowest to the highest mean deviation, without the scatter. This is what a table can remove
figure-e-one-way = The same for one direction of approach only
figure-m = From the lowest to the highest mean of both directions: the shape of the error along the axis
figure-r = Repeatability: how far returns to one position scatter at worst, both directions together. No table can remove it
figure-b = Reversal: how far the two directions of approach differ at worst. Backlash and lost motion show here
figure-b-mean = The same on average along the axis
figure-ap = Pose accuracy: from the commanded point to the middle of the measured ones
figure-rp = Pose repeatability: the radius of the sphere that holds the returns to one pose, mean plus three standard deviations
figure-vap = How far the middles differ when one pose is approached from different sides

## what the core says

finding-expected = { $found }; expected { $expected }
finding-at = { $place }: { $found }

# The core: causes of effects

core-the-column-does-not-stand-upright = the column does not stand upright on the base
core-the-bearings-raceways-are-wavy-so = the bearing's raceways are wavy, so that the axis tilts as it turns
core-play-between-gear-teeth-in-a = play between gear teeth, in a coupling or a key
core-the-measuring-frame-was-surveyed-to = the measuring frame was surveyed to a point beside the axis
core-raceways-or-seats-of-the-bearing = raceways or seats of the bearing are not round
core-the-encoders-ring-or-the-gear = the encoder's ring or the gear that drives it is mounted off centre
core-the-encoder-ring-is-tilted-or = the encoder ring is tilted or oval, or a coupling between encoder and shaft is bent
core-the-pedestal-the-floor-or-the = the pedestal, the floor or the base's bolts give way under the moment of load and arm
core-the-tripod-settles-or-the-base = the tripod settles, or the base creeps
core-somebody-touched-the-tripod-or-the = somebody touched the tripod, or the base slipped
core-tooth-or-wavegenerator-errors-in-the = tooth or wave-generator errors in the reducer; the order tells which wheel
core-the-instruments-distance-scale-or-its = the instrument's distance scale, or its air temperature and pressure, is off
core-reducer-bearing-and-shaft-wind-up = reducer, bearing and shaft wind up under the weight that hangs on the joint
core-the-gear-ratio-or-the-encoders = the gear ratio or the encoder's counts per turn are entered slightly wrong
core-the-reference-mark-or-the-homing = the reference mark or the homing position is not where the controller assumes it
core-the-link-or-the-structure-bends = the link or the structure bends under the load
core-links-are-longer-or-shorter-than = links are longer or shorter than drawn, axes are not square or not parallel
core-the-tool-or-the-link-is = the tool or the link is longer or shorter than the controller's data
core-friction-in-the-reducer-winds-the = friction in the reducer winds the drive up after each reversal
core-the-instrument-stands-where-it-was = the instrument stands where it was put
core-the-thread-of-the-screw-is = the thread of the screw is uneven, or the screw's bearing or the encoder on it runs out
core-the-arm-grows-as-it-warms = the arm grows as it warms up: steel by some 12 ppm/K, aluminium by 23
core-the-encoders-mounting-or-the-reducer = the encoder's mounting or the reducer turns a little as it warms up
core-the-tool-is-mounted-beside-the = the tool is mounted beside the radius that the controller assumes
core-the-tool-is-mounted-turned-or = the tool is mounted turned, or its data in the controller are
core-the-tool-data-in-the-controller = the tool data in the controller, or the place of the target on the tool
core-the-position-loop-follows-late-or = the position loop follows late, or the instrument's clock and the controller's differ
core-unknown-no-effect-of-the-catalogue = unknown: no effect of the catalogue explains it
core-the-drive-of-one-joint-turns = the drive of one joint turns another as well, and the controller's ratio for it is not exact

# The core: what to check

core-shim-the-columns-foot-level-it = shim the column's foot; level it along x and y
core-the-bearings-axial-seat-and-preload = the bearing's axial seat and preload
core-preload-and-wear-of-the-reducer = preload and wear of the reducer; rock the output by hand with the drive held
core-survey-the-base-again = survey the base again
core-the-bearings-seat-and-preload = the bearing's seat and preload
core-centre-the-encoder-ring-or-average = centre the encoder ring, or average a second reading head at 180°
core-check-the-rings-mounting-face-for = check the ring's mounting face for tilt and the ring for roundness
core-the-bolts-and-the-pedestal-a = the bolts and the pedestal; a dial gauge at the base while the loaded arm swings round
core-tripod-clamps-and-the-sun-on = tripod, clamps and the sun on the tripod's legs
core-return-to-the-datum-points-after = return to the datum points after the step; clamps and tripod
core-compare-the-order-with-the-reducers = compare the order with the reducer's tooth counts, then its preload and lubrication
core-measure-a-scale-bar-the-instruments = measure a scale bar; the instrument's weather station
core-the-payload-entered-in-the-controller = the payload entered in the controller; stiffness of the reducer in its data sheet
core-compare-the-gear-ratio-and-the = compare the gear ratio and the counts per turn in the controller with the data sheets
core-home-the-joint-again-and-repeat = home the joint again and repeat three poses
core-the-bolts-between-base-column-and = the bolts between base, column and link
core-the-kinematic-data-in-the-controller = the kinematic data in the controller
core-the-tool-data-in-the-controller-2 = the tool data in the controller
core-lubrication-and-preload-of-the-reducer = lubrication and preload of the reducer
core-measure-reference-points-on-the-base = measure reference points on the base in every setup
core-the-screws-runout-and-its-thrust = the screw's runout and its thrust bearing; the coupling and the encoder on the screw
core-let-the-machine-warm-up-before = let the machine warm up before measuring, or enter the arm's expansion in the controller
core-let-the-machine-warm-up-before-homing = let the machine warm up before homing; look for a heat source beside the encoder
core-the-tool-flange-and-the-tool = the tool flange and the tool data in the controller
core-measure-the-targets-on-the-tool = measure the targets on the tool
core-synchronise-the-clocks-then-the-loops = synchronise the clocks, then the loop's velocity gain and feed-forward
core-look-at-the-machine-where-the = look at the machine where the joint stands in that range: scale, bearing, cables, cover
core-the-coupling-ratio-in-the-controllers = the coupling ratio in the controller's data

# The core: usual sizes

core-any = any
core-10-m-of-eccentricity-on-a = 10 µm of eccentricity on a ring of 50 mm radius is 0.011°
core-005-to-1-mm-005-to = 0.05 to 1 mm, 0.05 to 2 mrad
core-012-to-023-mm-per-metre = 0.12 to 0.23 mm per metre and 10 K

# The core: parameters

core-about-x = about x
core-about-y = about y
core-about-z = about z
core-amplitude = amplitude
core-compliance = compliance
core-delay = delay
core-delta = delta
core-fade = fade
core-from-joint = from joint
core-lead = lead
core-offset = offset
core-order = order
core-phase = phase
core-rate = rate
core-ratio = ratio
core-scale = scale
core-time = time
core-width = width

# The core: what stays, and what to do about it

core-of-joint-leaves = { $a } of joint { $b } leaves { $c }: { $d }
core-leaves = { $a } leaves { $b }: { $c }
core-its-part-along-the-radius-belongs = its part along the radius belongs into the tool data (l1) or the base data of the controller; the exact method says into which
core-needs-a-mechanical-repair = needs a mechanical repair: { $a }
core-let-the-machine-warm-up-or = let the machine warm up, or enter the arm's expansion in the controller
core-move-the-tool-in-the-controllers = move the tool in the controller's tool data by { $a } across the radius
core-turn-the-base-in-the-controller = turn the base in the controller by { $a } about x and { $b } about y, or shim the column's foot
core-along-the-radius-set-the-tools = along the radius; set the tool's radius (l1) in the controller from { $a } to { $b }
core-move-the-base-in-the-controller = move the base in the controller by { $a }, or survey it again
core-the-joint-stands-beyond-its-command = the joint stands { $a } beyond its command: correct its zero in the controller, or home it again
core-move-the-tools-point-in-the = move the tool's point in the controller by { $a } in the tool frame

# The core: tables

core-the-numbers-are-corrections-add-them = the numbers are corrections: add them to the command, so that the robot ends up where it was commanded (the deviation measured − commanded has the other sign)
core-the-numbers-are-deviations-actual-commanded = the numbers are deviations, actual − commanded: the controller takes them away from the command (the correction, what is added to it, has the other sign)
core-commanded-robot-reached-table-says-send = commanded { $a }, robot reached { $b }, table says { $c }: send { $d }
core-with-this-table-the-controller-leaves = with this table the controller leaves { $a } over the measured range, where an exact correction leaves { $b }; { $c }
core-its-entries-add-less-than = its { $a } entries add { $b }, less than { $c } ({ $d })
core-its-entries-add-more-than-the = its { $a } entries add { $b }, more than { $c } ({ $d }): the step is wide
core-its-entries-add-more-than-takes = its { $a } entries add { $b }, more than { $c } ({ $d }): { $e } takes at most { $f }
core-1-of-the-tolerance = 1 % of the tolerance
core-1-of-001-mm-as-there = 1 % of 0.01 mm, as there is no tolerance
core-1-of-the-models-rms-error = 1 % of the model's RMS error, as there is no tolerance
core-the-joint-has-no-limits-the = the joint has no limits: the table covers the measured range
core-a-step-of-does-not-divide = a step of { $a } does not divide the travel: the steps are { $b }
core-measured-from-to-outside-the-correction = measured from { $a } to { $b }; outside, the correction at the end of that range is held
core-the-of-this-joint-depends-on = the { $a } of this joint depends on the other joints: they stand at home here
core-the-correction-jumps-at-the-boundaries = the correction jumps at the boundaries of the regions; between two entries the table makes a ramp of it
core-up-to-of-it-is-an = up to { $a } of it is an unexplained smooth correction, measured from { $b } to { $c }: no effect of the catalogue explains it, and outside that range its end values are held

# The core: targets and programs

core-poses-for-which-the-file-declares = poses for which the file declares no frame are read { $a }; the tool of the controller has to be the model's where the file has one tool only
core-in-the-robots-base-frame = in the robot's base frame
core-in-the-frame-that-was-stated = in the frame that was stated
core-the-robots-base-is-the-frame = the robot's base is the frame in which the session was measured
core-the-robots-base-is-where-its = the robot's base is where its first axis is; the measuring frame stands { $a } and { $b } from it (--measured-frame corrects to that frame)
core-targets-without-a-load-are-corrected = targets without a load are corrected for { $a }
core-targets-without-a-temperature-are-corrected = targets without a temperature are corrected for { $a }

# The core: tolerance

core-pass = Pass
core-fail = Fail
core-neither-pass-nor-fail-is-proven = Neither pass nor fail is proven
core-largest-deviation-expanded-uncertainty-u-k = largest deviation { $a } ({ $b }), expanded uncertainty U = { $c } (k = 2), tolerance { $d }; decision rule: { $e }
core-predicted-with-corrected-commands = predicted with corrected commands
core-as-measured-with-the-table-active = as measured with the table active
core-simple-acceptance-jcgm-106-82 = simple acceptance (JCGM 106, 8.2)
core-no-position-was-measured = no position was measured
core-no-command-can-be-corrected = no command can be corrected
core-the-noise-of-the-instrument-is = the noise of the instrument is not known

# The core: noise and fit

core-the-measuring-frame-wanders-by-root = the measuring frame wanders by { $a } (root mean square) within { $b }
core-a-part-of-the-remaining-error = a part of the remaining error goes on from sample to sample, { $a } (root mean square) within { $b }: a diagnosis looks for effects in it
core-as-found-as-stated-for-the = σ = { $a } as found, { $b } as stated for the instrument ({ $c } times)
core-a-joint-value-or-a-coordinate = a joint value or a coordinate is missing
core-the-instrument-lost-the-reflector-it = the instrument lost the reflector: it wrote 0, 0, 0
core-by-hand = by hand
core-converged = converged
core-there-was-nothing-to-solve-for = there was nothing to solve for
core-stopped-after-the-largest-number-of = stopped after the largest number of steps: the result may be rough
core-stopped-where-no-step-made-the = stopped where no step made the fit better: the result may be rough
core-cancelled = cancelled
core-z-is-not-used-the-method = z is not used: the method works in the plane in which the axis moves the tool
core-corrections-are-constant-in-the-base = corrections are constant in the base frame within a region: one constant error of the joint looks different in every region, and a part of it stays; the exact method has neither limit
core-no-sample-in-region-no-correction = no sample in region { $a }: no correction there
core-samples-lie-in-no-region-and = { $a } samples lie in no region and were not used
core-the-targets-do-not-sit-where = the targets do not sit where the session says within targets_sigma_mm: their places are fitted freely
core-beyond-what-is-usual-by-more = beyond what is usual by more than four times, and fitted without a prior: { $a }
core-the-measuring-frame-was-never-aligned = the measuring frame was never aligned with the robot's base (turned by { $a }, moved by { $b }): it is fitted freely
core-the-samples-do-not-depend-on = the samples do not depend on it: it is held at zero
core-the-samples-do-not-depend-on-it = the samples do not depend on it
core-the-samples-show-only-their-sum = the samples show only their sum: { $a } is held at zero, the others carry it
core-the-samples-show-only-their-sum-a = the samples show only their sum: a change of one can be undone by the others
core-overall-size-all-lengths-of-the = overall size: all lengths of the robot and of the places together
core-the-base-is-open-what-was = the base is open: what was measured refers to places that are not known, and does not say where the robot stands; it is held where it is, and the places carry it

# The core: a model on other samples

core-the-sessions-robot-has-than-the = the session's robot has { $a } than the model's: the model's nominal robot is used
core-another-tool = another tool
core-other-axes = other axes
core-the-session-was-measured-with-this = the session was measured with this model's table active: it shows what is left, and is not compensated a second time
core-the-session-was-measured-with-another = the session was measured with another model's table active: it is not compensated a second time, and this model does not know what that table did
core-belong-to-the-session-that-the = { $a } belong to the session that the model came from and are left out
core-the-model-knows-no-setup-its = the model knows no setup { $a }: its frame is fitted to these samples
core-not-known-to-the-model-and = not known to the model, and located beside it: { $a }

# The core: tables of several joints

core-the-table-cancels-what-joint-does = the table cancels what joint { $a } does to its own { $b }; errors of the geometry depend on all joints and belong into the controller's kinematic data
core-angle = angle
core-travel = travel

# The core: held out

core-each-fifth-of-the-measurements-of = each fifth of the measurements, of every reference its own, predicted by a fit that has not seen it
core-each-of-cells-of-the-workspace = each of { $a } cells of the workspace predicted by a fit that has not seen it
core-each-fifth-of-the-cells-of = each fifth of the cells of the workspace predicted by a fit that has not seen it
core-the-samples-that-the-session-marks = the samples that the session marks as held out; no fit touched them
core-too-few-samples-to-hold-any = too few samples to hold any out

# The core: what is left without a name

core-no-effect-of-the-catalogue-explains = { $a }; no effect of the catalogue explains it
core-the-base-model-does-not-fit = the base model does not fit: axes, tool or masses; { $a }
core-what-is-left-looks-most-like = what is left looks most like { $a }
core-the-search-stopped-at-its-limit = the search stopped at its limit of { $a } effects; { $b }
core-the-remaining-error-of-is-times = the remaining error of { $a } is { $b } times what { $c }, without a structure that the search knows
core-the-remaining-error-is-times-what = the remaining error is { $a } times what { $b }, without a structure that the search knows
core-returns-to-the-same-pose-show = returns to the same pose show
core-returns-to-the-same-pose-show-2 = returns to the same pose show ({ $a })
core-is-stated-for-the-instrument = is stated for the instrument
core-is-stated-for-the-instrument-2 = is stated for the instrument ({ $a })
core-over-the-value-of-joint = { $a } over the value of joint { $b }, { $c }
core-over-time = { $a } over time, { $b }
core-over-the-side-from-which-joint = { $a } over the side from which joint { $b } came, { $c }
core-over-the-speed-of-joint = { $a } over the speed of joint { $b }, { $c }
core-over-the-load = { $a } over the load, { $b }
core-over-temperature = { $a } over temperature, { $b }
core-of-one-reflector-against-the-others = { $a } of one reflector against the others, { $b }
core-a-constant = a constant
core-a-straight-slope = a straight slope
core-a-slope-away-from-the-middle = a slope away from the middle
core-a-parabola = a parabola
core-a-curve-of-no-known-form = a curve of no known form
core-a-local-bump = a local bump
core-a-step-or-plateau = a step or plateau
core-a-slope-from-one-value-on = a slope from one value on
core-a-wave = a wave
core-a-periodic-pattern-with-harmonics = a periodic pattern with harmonics
core-a-wave-of-one-turn-in = a wave of one turn in proportion
core-along-the-motion-of-joint = along the motion of joint { $a }
core-along-the-radius = along the radius
core-along-the-axis = along the axis
core-in-the-measuring-frame = in the measuring frame
core-with-the-moving-body = with the moving body
core-joint-from-to = joint { $a } from { $b } to { $c }
core-speed-of-joint-from-to = speed of joint { $a } from { $b } to { $c }
core-time-from-to = time from { $a } to { $b }
core-load-from-to = load from { $a } to { $b }
core-temperature-from-to = temperature from { $a } to { $b }
core-cycles-per-turn-of = { $a } cycles per turn of { $b }
core-cycles-per-metre-of = { $a } cycles per metre of { $b }
core-joint = joint { $a }
core-speed-of-joint = speed of joint { $a }
core-side-from-which-joint-came = side from which joint { $a } came
core-load = load
core-temperature = temperature

# The core: what tells explanations apart

core-measure-the-proposed-pose = measure the proposed pose
core-measure-the-proposed-pose-with = measure the proposed pose with { $a }
core-measure-the-proposed-poses = measure the { $a } proposed poses
core-measure-the-proposed-poses-with = measure the { $a } proposed poses with { $b }
core-a-reflector-at-another-radius = a reflector at another radius
core-other-speeds = other speeds
core-other-loads = other loads
core-another-temperature = another temperature
core-no-pose-within-the-limits-tells = no pose within the limits tells them apart; { $a }
core-approach-the-same-places-from-both = approach the same places from both sides
core-measure-in-motion-at-two-speeds = measure in motion at two speeds as well
core-measure-without-and-with-a-load = measure without and with a load
core-measure-with-the-machine-cold-and = measure with the machine cold and warm, and again while it cools down
core-spread-the-poses-over-the-whole = spread the poses over the whole travel
core-mount-a-second-reflector-at-another = mount a second reflector at another radius
core-write-down-the-time-of-every = write down the time of every sample (time_s)
core-measure-z-as-well = measure z as well
core-give-the-direction-of-gravity-in = give the direction of gravity in the robot's file (gravity_m_s2)
core-the-joint-turns-the-effect-needs = the joint turns, the effect needs one that slides
core-the-joint-slides-the-effect-needs = the joint slides, the effect needs one that turns
core-the-joint-was-measured-at-different = the joint was measured at { $a } different values, at least { $b } are needed
core-the-session-does-not-say-from = the session does not say from which side the poses were approached
core-every-pose-was-approached-from-the = every pose was approached from the same side
core-the-session-does-not-say-how = the session does not say how fast the joint moved while it was measured
core-every-pose-was-measured-at-standstill = every pose was measured at standstill
core-every-pose-was-measured-at-the = every pose was measured at the same signed speed
core-the-session-has-no-temperature = the session has no temperature
core-the-temperature-never-changed = the temperature never changed
core-the-session-has-no-time = the session has no time
core-every-sample-has-the-same-time = every sample has the same time
core-the-direction-of-gravity-is-not = the direction of gravity is not given
core-the-session-has-no-load = the session has no load
core-the-load-never-changed = the load never changed
core-the-robot-has-several-joints-link = the robot has several joints: link geometry takes its place
core-the-tool-lies-on-the-axis = the tool lies on the axis and has no radius
core-z-was-not-measured-and-the = z was not measured, and the effect is along the axis
core-in-these-samples-it-cannot-be = in these samples it cannot be told from the geometry: frame, zero offsets, links and tool
core-in-these-samples-it-cannot-be-told = in these samples it cannot be told from joint-zero-offset and link-length

# The core: mistakes of the set-up

core-in-these-samples-the-same-as = { $a }; in these samples the same as: { $b }
core-joint-counts-the-other-way-round = joint { $a } counts the other way round
core-reverse-the-sign-of-joint-in = reverse the sign of joint { $a } in the robot's description or in the samples
core-joints-and-are-exchanged = joints { $a } and { $b } are exchanged
core-exchange-the-columns-of-joints-and = exchange the columns of joints { $a } and { $b }
core-the-measured-points-follow-the-joint = the measured points follow the joint values that were read back, not the commanded ones
core-start-from-the-values-read-back = start from the values read back (--joint-values read), and check where the commands come from
core-joints-and-are-coupled-parallelogram-but = joints { $a } and { $b } are coupled (parallelogram) but were taken for uncoupled
core-joints-and-are-uncoupled-but-were = joints { $a } and { $b } are uncoupled but were taken for coupled (parallelogram)
core-the-home-position-of-joint-is = the home position of joint { $a } is off by { $b }
core-add-to-joint-at-home-or = add { $a } to joint { $b } at home, or home the joint again
core-the-home-positions-of-joints-and = the home positions of joints { $a } and { $b } are off by 180°
core-correct-the-unit-in-the-headings = correct the unit in the headings of the joints
core-correct-the-unit-in-the-heading = correct the unit in the heading of { $a }
core-correct-the-unit-in-the-headings-of = correct the unit in the headings of x, y and z
core-two-of-the-measured-axes-are = two of the measured axes are swapped (such as x and y), or one of them is reversed
core-the-measured-axes-are-swapped = the measured axes { $a } are swapped
core-x-and-y = x and y
core-y-and-z = y and z
core-x-and-z = x and z
core-x-y-and-z-read-as = x, y and z (read as y, z, x)
core-x-y-and-z-read-as-z = x, y and z (read as z, x, y)
core-exchange-the-headings-of-the-measured = exchange the headings of the measured columns
core-exchange-the-headings-of-the-measured-columns = exchange the headings of the measured columns, or reverse one of them
core-the-measuring-frame-was-never-aligned-with = the measuring frame was never aligned with the robot's base
core-align-the-instrument-turned-by-moved = align the instrument (turned by { $a }, moved by { $b }), or give the samples a `setup` column so that the frame is fitted
core-with-the-frame-the-tool-and = with the frame, the tool and the zero offsets fitted the median error is { $a } as it stands and { $b } without the mistake
core-with-zero-offset-and-link-length = with zero offset and link length fitted the RMS error is { $a } as it stands and { $b } without the mistake
core-far-beyond-what-adjusting-could-mend = far beyond what adjusting could mend
core-the-median-error-is-as-it = the median error is { $a } as it stands and { $b } with the frame fitted
core-no-geometry-fits-the-samples-as = no geometry fits the samples as they stand; with the frame fitted the median error is { $a }
core-the-instrument-lost-the-reflector-in = the instrument lost the reflector in { $a }
core-it-wrote-0-0-0 = it wrote 0, 0, 0
core-these-samples-are-left-out-measure = these samples are left out; measure them again
core-the-instrument-saw-reflector-instead-in = the instrument saw reflector { $a } instead in { $b }
core-the-points-lie-where-should-be = the points lie where { $a } should be
core-these-samples-are-left-out-correct = these samples are left out; correct their target or measure them again
core-the-instrument-was-locked-on-a = the instrument was locked on a point that does not move in { $a }
core-the-measured-point-stays-while-the = the measured point stays while the robot moves
core-sample = sample { $a }
core-samples = samples { $a }
core-samples-and-more = samples { $a } and { $b } more
core-the-values-read-back-from-joint = the values read back from joint { $a } lag the command by { $b }
core-read-joint-back-at-standstill-taken = read joint { $a } back at standstill; taken as they are, these values look like backlash or tracking lag
core-reverse-joint = Reverse joint { $a }
core-read-joint-as-degrees = Read joint { $a } as degrees
core-read-joint-as-radians = Read joint { $a } as radians
core-read-all-joints-as-degrees = Read all joints as degrees
core-read-all-joints-as-radians = Read all joints as radians
core-exchange-joints-and = Exchange joints { $a } and { $b }
core-subtract-joint-from-joint = Subtract joint { $a } from joint { $b }
core-add-joint-to-joint = Add joint { $a } to joint { $b }
core-start-from-the-values-read-back-2 = Start from the values read back
core-turn-the-home-of-joint-by = Turn the home of joint { $a } by { $b }
core-read-the-coordinates-as-metres = Read the coordinates as metres
core-read-the-coordinates-as-inches = Read the coordinates as inches
core-read-the-coordinates-as-micrometres = Read the coordinates as micrometres
core-multiply-the-coordinates-by = Multiply the coordinates by { $a }
core-exchange-x-and-y = Exchange x and y
core-read-x-y-z-from = Read x, y, z from { $a }
core-fit-the-measuring-frame = Fit the measuring frame
core-remove = Remove { $a }
core-remove-this-sample = Remove this sample
core-remove-these-samples = Remove these { $a } samples
core-add-joint-in-the-value-of = add joint { $a } in the value of joint { $b }
core-subtract-joint-in-the-value-of = subtract joint { $a } in the value of joint { $b }

# The core: findings about a session

core-the-noise-of-the-instrument-is-not = the noise of the instrument is not given: it is estimated from the samples
core-measured = measured: { $a }
core-measured-with-the-table-of-model = measured with the table of model { $a } active: it shows what is left, and nothing compensates it a second time
core-regions-and-overlap = regions { $a } and { $b } overlap
core-regions-that-touch-at-most-the = regions that touch at most; the one listed first owns what both claim
core-two-regions-are-called = two regions are called { $a }
core-a-name-of-its-own-for = a name of its own for each region
core-a-name-of-its-own-for-each = a name of its own for each joint
core-regions-are-for-a-robot-with = regions are for a robot with a single revolute joint: they will not be used
core-targets-but-no-column-target-every = { $a } targets but no column target: every sample is taken to show { $b }
core-a-column-target = a column target
core-no-sample-shows-this-target = no sample shows this target
core-no-sample-has-its-commanded-values = no sample has its commanded values and anything measured
core-at-least-one-complete-sample = at least one complete sample
core-of-samples-lack-a-commanded-value = { $a } of { $b } samples lack a commanded value or everything measured and cannot be used: { $c }
core-of-samples-are-excluded-by-hand = { $a } of { $b } samples are excluded by hand and count in no figure: { $c }
core-of-samples-lack-single-coordinates-the = { $a } of { $b } samples lack single coordinates; the others of them are fitted: { $c }
core-no-column-for-the-measured-z = no column for the measured z: the session is planar
core-every-sample-is-held-out-or = every sample is held out or excluded: nothing is left to fit
core-some-samples-marked-fit = some samples marked fit
core-measured-orientations-are-not-of-unit = { $a } measured orientations are not of unit length: { $b }
core-unit-quaternions = unit quaternions
core-samples-are-beyond-the-limits-of = { $a } samples are beyond the limits of joint { $b }: { $c }
core-commands-within-the-limits = commands within the limits
core-negative-loads = negative loads: { $a }
core-0-kg-or-more = 0 kg or more
core-temperatures-below-absolute-zero = temperatures below absolute zero: { $a }
core-the-time-does-not-increase-at = the time does not increase at { $a }; file order is taken as measuring order
core-setups-each-has-a-measuring-frame = { $a } setups: each has a measuring frame of its own
core-the-instrument-lost-the-reflector-0 = the instrument lost the reflector (0, 0, 0) in { $a } samples: { $b }
core-they-are-left-out = they are left out

# The core: figures of the standards

core-samples-are-left-out-a-cell = { $a } samples are left out: a cell is missing, the reflector was lost, or they are excluded by hand
core-no-point-was-measured-xmm-ymm = no point was measured (x_mm, y_mm): the figures of both standards are of positions that were measured at commanded ones; distances, directions, sockets and touches alone give none
core-the-session-was-measured-with-a = the session was measured with a table active: the figures are those with compensation, and nothing is compensated a second time
core-samples-were-taken-in-motion-the = samples were taken in motion; the standards measure at standstill, so that lag is in these figures
core-poses-with-two-cycles-or-more = { $a } poses with two cycles or more, { $b } from several directions, { $c } paths; the largest of each figure
core-no-pose-was-reached-twice-from = no pose was reached twice from the same direction, after another pose
core-no-pose-was-repeated-from-several = no pose was repeated from several directions
core-z-was-not-measured-figures-are = z was not measured: figures are in the plane

# The core: import

core-decimal-point = decimal point
core-decimal-comma = decimal comma
core-the-unit-of-the-joint-values = the unit of the joint values is not said

# The core: units that were mistaken

core-the-values-of-joint = the values of joint { $a } { $b }
core-the-values-of-all-joints = the values of all joints { $a }
core-are-in-degrees-but-were-read = are in degrees but were read as radians
core-are-in-radians-but-were-read = are in radians but were read as degrees
core-the-measured-coordinates-are = the measured coordinates are { $a }
core-in-metres-but-were-read-as = in metres but were read as millimetres
core-in-micrometres-or-were-multiplied-by = in micrometres or were multiplied by 1000
core-in-inches-but-were-read-as = in inches but were read as millimetres
core-in-millimetres-but-were-read-as = in millimetres but were read as inches
core-the-unit-of-x-y-z = the unit of x, y, z is not said: { $a }
core-the-points-spread-over-as-m = the points spread over { $a }: as m that would be { $b }, as mm { $c }, as in { $d }; { $e }
core-would-suit = { $a } would suit, { $b }
core-as-robots-are-mostly-as-large = as robots are mostly as large as people
core-beside-a-robot-that-reaches = beside a robot that reaches { $a }
core-positions-each-approached-from-below-and = { $a }; { $b } positions, each approached { $c } from below and { $d } from above
core-all-samples-alike = all samples alike
core-reflector = reflector { $a }
core-reflector-2 = reflector { $a }, { $b }
core-load-2 = load { $a }
core-load-3 = load { $a }, { $b }
core-measured-at = measured at { $a }
core-measured-at-2 = measured at { $a }, { $b }
core-setup = setup { $a }
core-setup-2 = setup { $a }, { $b }
core-other-joints-at = other joints at { $a }
core-never = never
core-once-or-more = once or more
core-twice-or-more = twice or more
core-times-or-more = { $a } times or more
core-more-series-under-other-conditions-are = { $a } more series under other conditions are in `standards --json`
core-of-positions-have-fewer-approaches-than = { $a } of { $b } positions have fewer approaches than the others and are left out
core-not-every-position-was-approached-from = not every position was approached from { $a }: no figure that needs that side, and no reversal
core-a-position-was-approached-once-from = a position was approached once from { $a }: no standard deviation, so no repeatability and no accuracy
core-below = below
core-above = above
core-approaches-from-each-side-the-standard = { $a } approaches from each side; the standard asks for { $b }
core-positions-over-the-standard-asks-for = { $a } positions over { $b }; the standard asks for { $c }
core-paths-with-as-few-as-cycles = paths with as few as { $a } cycles; the standard asks for { $b }
core-poses-with-as-few-as-cycles = poses with as few as { $a } cycles; the standard asks for { $b }
core-no-pose-beside-the-paths-was = no pose beside the paths was reached twice
core-the-side-from-which-a-joint = the side from which a joint came is not known: its directions are taken to be one
core-the-side-from-which-the-joint = the side from which the joint came is not known: column { $a } is missing
core-metres = metres
core-millimetres = millimetres
core-inches = inches
core-an-iso-2302-run-targets-and = an ISO 230-2 run: targets and positions of one axis
core-a-camera-that-sees-a-calibration = a camera that sees a calibration board: rvec and tvec of each image
core-a-tum-trajectory-time-position-quaternion = a TUM trajectory: time, position, quaternion
core-any-program-a-table-with-a = any program: a table with a header, or with columns chosen below
core-an-mcap-recording-joint-states-and = an MCAP recording: joint states and measured poses
core-a-ballbar-a-drawwire-or-an = a ballbar, a draw-wire or an interferometer: distances
core-a-laser-tracker-or-spatialanalyzer-names = a laser tracker or SpatialAnalyzer: names, x, y, z

# The core: places in files

core-line-column = { $a }, line { $b }, column { $c }, { $d }
core-line-column-2 = { $a }, line { $b }, column { $c }
core-line = { $a }, line { $b }
core-line-column-3 = line { $a }, column { $b }
core-line-2 = line { $a }

# The core: exports

core-zeros-base-and-tool-frame = Zeros, base and tool frame
core-mjcf-with-corrected-bodies = MJCF with corrected bodies
core-urdf-with-corrected-origins = URDF with corrected origins
core-kinematics-of-urdescription = Kinematics of ur_description
core-denavithartenberg-rows = Denavit–Hartenberg rows
core-lerobot-motor-calibration-and-urdf = LeRobot motor calibration and URDF
core-c99-header-with-a-lookup-function = C99 header with a lookup function
core-csv-table-with-json-metadata = CSV table with JSON metadata
core-twincat-cnc-isg-list = TwinCAT CNC (ISG) list
core-twincat-nc-structured-text = TwinCAT NC structured text
core-the-numbers-are-the-corrected-geometry = the numbers are the corrected geometry itself: where joints and tool really are; nothing is added to a command
core-this-robot-carries-it-is-from = this robot carries { $a }; it is { $b } from the model over the measured range (largest { $c }), the nominal one { $d } (root mean square)
core-zero-offsets-base-and-tool-frame = zero offsets, base and tool frame
core-zero-offsets-base-and-tool-frame-and = zero offsets, base and tool frame, and the geometry of the links
core-at-home-the-nominal-tool-is = at home the nominal tool is at { $a }, and this robot has it at { $b }
core-has-no-place-in-at-standstill = { $a } has no place in { $b }: at standstill, without load and at 20 °C it leaves nothing
core-has-no-place-in-it-leaves = { $a } has no place in { $b }: it leaves { $c }
core-the-zero-offsets-are-in-this = the zero offsets are in this file: leave the zeros of the controller as they are
core-no-joint-has-a-zero-offset = no joint has a zero offset for the controller to take
core-the-zero-offsets-are-left-to = the zero offsets are left to the controller and are not in this file: its joints stand beyond what it shows, { $a }; move its zeros so that it shows as much more
core-the-zero-offsets-in-this-file = the zero offsets in this file are the controller's to take: it has to show as much more as each joint stands beyond its command
core-base-where-the-robot-really-stands = base: where the robot really stands, in the base frame; tool: the real tool in the frame of the nominal one (new tool data = present tool data times this); zeros: how far each joint stands beyond its command
core-base-the-robots-base-in-the = base: the robot's base in the base frame; tool: the real tool in the frame of the nominal one
core-the-geometry-of-the-links-is = the geometry of the links is not in these numbers; dh, urdf or mjcf carry it
core-rows-cannot-say-where-the-first = rows cannot say where the first axis stands in the base: enter base as well
core-base-the-frame-before-the-first = base: the frame before the first row in the base frame; tool: the tool in the frame behind the last row
core-rows-in-the-convention = rows in the { $a } convention
core-base-the-frame-that-the-first = base: the frame that the first link is told in; tool: the TCP in the frame of wrist_3
core-set-the-tcp-to-with-the = set the TCP to { $a } with the rotation vector { $b }: the tool is not part of this file
core-for-the-launch-argument-kinematicsparamsfile-the = for the launch argument kinematics_params_file; the driver compares its hash with the controller's own calibration and warns that they differ
core-masses-are-not-written-a-calibration = masses are not written: a calibration does not know the inertia of a link
core-names-that-are-empty-or-not = names that are empty or not unique were changed: the file needs one for each
core-syntax-from-the-manual-not-tried = syntax from the manual, not tried on a controller
core-the-motors-show-more-than-before = the motors show more than before, in ticks: { $a }; their ranges move by as much with it: keep away from the stops until you have tried it
core-the-calibration-by-itself-with-the = the calibration by itself, with the nominal URDF, leaves { $a } over the measured range (level: zeros)
core-feetech-present-actual-homingoffset-a-joint = Feetech: present = actual − homing_offset; a joint that stands beyond its command gets a smaller homing_offset
core-dynamixel-present-actual-homingoffset-a-joint = Dynamixel: present = actual + homing_offset; a joint that stands beyond its command gets a larger homing_offset
core-the-calibration-by-itself-carries-the = the calibration by itself carries the zeros; the URDF beside it carries the rest and agrees with this motor calibration only
core-the-zero-offsets-are-in-homingoffset = the zero offsets are in homing_offset of this calibration, in whole ticks, and the rest of them in the URDF beside it: nothing else is to take them
core-the-zero-offsets-are-in-the = the zero offsets are in the URDF beside this calibration, which is as it was
core-no-calibration-was-given-the-homing = no calibration was given: the homing offsets count from 0, and ids and ranges are placeholders; give the one that was active while measuring with --reference
core-in-the-ini-file-the-joint = in the INI file: { $a }; the joint has { $b }
core-backlash-is-ignored-while-compfile-is = BACKLASH is ignored while COMP_FILE is set: the two columns carry it
core-in-the-machine-data-md38000-mmenccompmaxpoints = in the machine data: MD38000 MM_ENC_COMP_MAX_POINTS at least { $a }, and after loading { $b }; the axis has to be called { $c }
core-switched-on-after-referencing-the-axis = switched on after referencing, the axis moves at once by the correction at the reference point, { $a } at 0
core-the-808d-holds-points-for-it = the 808D holds { $a } points; for it give a wider step
core-ismodulo-1-is-for-a-modulo = IS_MODULO = 1 is for a modulo axis; for one that ends, set it to 0
core-modulo-1-is-for-a-modulo = modulo 1 is for a modulo axis; for one that ends, set it to 0
core-in-the-axis-list-have-to = in the axis list: { $a }; { $b } have to be those of the axis; no other backlash compensation beside it
core-the-largest-value-needs-a-build = the largest value, { $a }, needs a build with values of 32 bits; older ones hold 16
core-in-the-plc-the-axis-counts = in the PLC: { $a }; the axis counts in { $b }
core-no-joint-removes-root-mean-square = no joint removes { $a } (root mean square over the measured range)

# The core: poses to measure next

core-makes-and-more-testable = makes { $a } and { $b } more testable: { $c }
core-makes-testable = makes { $a } testable: { $b }
core-what-the-others-are-compared-with = what the others are compared with
core-tells-they-differ-most-at = tells { $a }: they differ most at { $b }
core-not-determined = not determined
core-implausibly-large-more-than-ten-times = implausibly large: more than ten times what is usual
core-not-determined-by-these-samples = { $a }: not determined by these samples
core-any-size-there-is-no-noise = { $a }: any size, there is no noise
core-not-observable-with-these-poses = { $a }: not observable with these poses
core-pose = pose
core-from = from
core-reflector-3 = reflector
core-conditions = conditions
core-second-time = second time
core-is-a-new-reflector-mount-it = { $a } is a new reflector: mount it at { $b } in the tool frame, and survey where it really is
core-with = with
core-joint-2 = Joint { $a } ({ $b })
core-poses = Poses

# The core: what of a program is not corrected

core-its-position-is-singular-a-small = its position is singular: a small correction would take a large move of the joints
core-the-real-tool-does-not-reach = the real tool does not reach it: { $a } are left
core-its-correction-would-lead-into-another = its correction would lead into another configuration
core-with-its-correction = { $a } with its correction
core-no-joint-values-within-the-limits = no joint values within the limits reach it
core-endlessly-many-joint-values-reach-it = endlessly many joint values reach it, and no target before it says which
core-no-joint-values-near-those-of = no joint values near those of the target before reach it
core-joint-values-reach-it-but-none = joint values reach it, but none with its configuration
core-several-joint-values-reach-it-and = several joint values reach it, and no target before it says which
core-two-sets-of-joint-values-reach = two sets of joint values reach it that are as near to the target before
core-no-joint-values-reach-it = no joint values reach it
core-it-is-singular-lines-of-joint = it is singular: lines of joint values reach it
core-joint-would-be-at-beyond-its = joint { $a } would be at { $b }, beyond its limit of { $c }
core-its-orientation-is-none = its orientation is none
core-goes-to-which-is-worked-out = { $a } goes to { $b }, which is worked out at run time
core-is-worked-out-at-run-time = { $a } is worked out at run time
core-is-changed-at-run-time = { $a } is changed at run time
core-is-chosen-at-run-time = { $a } is chosen at run time
core-is-not-written-out-in-numbers = { $a } is not written out in numbers
core-is-declared-elsewhere = { $a } is declared elsewhere
core-is-declared-several-times = { $a } is declared several times
core-has-its-numbers-elsewhere = { $a } has its numbers elsewhere
core-has-no-value-in-this-file = { $a } has no value in this file
core-shifts-the-poses-after-it = { $a } shifts the poses after it
core-moves-by-a-way-from-where = { $a } moves by a way from where the robot is
core-its-frame-is-not-known = its frame is not known: { $a }
core-its-tool-is-not-known = its tool is not known: { $a }
core-its-tool-is-declared-elsewhere = its tool { $a } is declared elsewhere
core-which-tool-it-is-of-is = which tool it is of is not said
core-is-gone-to-from-several-sides = { $a } is gone to from several sides; effects of the side are left out
core-is-used-here-as-well-with = { $a } is used here as well, with its corrected values
core-is-a-pose-that-no-move = { $a } is a pose that no move of this file goes to
core-is-not-corrected = { $a } is not corrected: { $b }
core-another-routine-of-this-file-sets = another routine of this file sets it
core-it-is-set-in-a-branch = it is set in a branch or a loop

# The core: held out by joint

core-each-fifth-of-the-positions-of = each fifth of the positions of joint { $a } (spread over its range) predicted by a fit that has not seen it
core-no-two-positions-of-the-joint = no two positions of the joint were measured with everything else alike (other joints, reflector, load, speed) and a reflector off the axis
core-semicolons = semicolons
core-commas = commas
core-tabs = tabs
core-spaces = spaces

# The core: steps of the gap chart

core-nominal-robot = nominal robot
core-zero-offset-and-link-length = zero offset and link length
core-geometry-frame-zero-offsets-links-and = geometry: frame, zero offsets, links and tool
core-full-model = full model

# The core: problems of a file

core-expected = { $a }: { $b }; expected { $c }
core-the-end-of-the-document = the end of the document
core-the-end-of-the-file = the end of the file
core-a-key-in-double-quotes = a key in double quotes
core-the-key-a-second-time = the key { $a } a second time
core-every-key-once = every key once
core-after-the-key = ':' after the key
core-or = ',' or ']'
core-a-text = a text
core-an-object = an object
core-an-array = an array
core-an-array-of-objects = an array of objects
core-an-array-of-numbers = an array of numbers
core-an-array-of-numbers-null-where = an array of numbers (null where one is missing)
core-an-array-of-texts-null-where = an array of texts (null where one is missing)
core-an-array-with-an-object-for = an array with an object for each joint
core-an-array-with-a-frame-for = an array with a frame for each joint
core-an-array-of-regions = an array of regions
core-an-array-of-names-of-stations = an array of names of stations
core-an-array-of-numbers-2 = an array of { $a } numbers
core-an-array-of-numbers-3 = an array of { $a } numbers: { $b }
core-the-position-in-the-tool-frame = the position in the tool frame, mm
core-the-position-in-the-measuring-frame = the position in the measuring frame, mm; or null
core-the-centre-at-home-in-the = the centre at home, in the base frame
core-a-direction-that-is-not-zero = a direction that is not zero
core-where-the-tracker-stands-mm = where the tracker stands, mm
core-an-object-with = an object with { $a }
core-an-object-with-and = an object with { $a } and { $b }
core-an-object-with-and-2 = an object with { $a }, { $b } and { $c }
core-an-object-with-or-null = an object with { $a }, or null
core-an-object-with-and-or-null = an object with { $a } and { $b }, or null
core-an-object-with-a-number-for = an object with a number for each parameter
core-an-object-with-a-position-for = an object with a position for each name
core-an-object-with-an-array-for = an object with an array for each column
core-an-object-with-an-entry-for = an object with an entry for each name
core-an-object-that-describes-the-robot = an object that describes the robot
core-an-object-that-describes-a-region = an object that describes a region
core-an-object-that-describes-a-joint = an object that describes a joint
core-a-number-above-0 = a number above 0
core-a-number-above-0-or-null = a number above 0, or null
core-a-positive-number-or-an-array = a positive number, or an array of 3 positive numbers
core-a-range-from-the-smaller-to = a range from the smaller to the larger value
core-a-region-from-the-smaller-to = a region from the smaller to the larger value
core-an-empty-array = an empty array
core-a-robot-without-joints = a robot without joints
core-a-direction-of-zero-length = a direction of zero length
core-a-quaternion-of-zero-length = a quaternion of zero length
core-an-axis-of-zero-length = an axis of zero length
core-a-direction-such-as = a direction such as { $a }
core-a-quaternion-such-as = a quaternion such as { $a }
core-a-number-that-a-double-can = a number that a double can hold (below 1.8e308)
core-a-number-that-overflows = a number that overflows
core-an-array-with-a-number-that = an array with a number that overflows
core-an-array-with-null-in-it = an array with null in it
core-one-finite-number = one finite number
core-a-length-above-0-mm = a length above 0 mm
core-a-length-above-0-mm-or = a length above 0 mm, or null
core-a-mass-of-0-kg-or = a mass of 0 kg or more
core-a-joint-counted-from-1 = a joint, counted from 1
core-a-name-that-truepose-effects-lists = a name that `truepose effects` lists
core-one-of-joints-with-tool-dh = one of joints (with tool), dh, urdf or mjcf
core-not-a-regular-file = not a regular file
core-a-file-that-grows = a file that grows
core-a-document-with-a-key-format = a document with a key format
core-a-json-value = a JSON value
core-a-text-that-never-ends = a text that never ends
core-a-control-character-in-a-text = a control character in a text
core-regions-of-another-robot-than-one = regions of another robot than one with a single turning joint
core-no-regions-for-this-robot = no regions for this robot
core-rows-that-a-robot-can-be = rows that a robot can be built from
core-a-station-of-the-session = a station of the session
core-an-include-that-leads-elsewhere = an include that leads elsewhere
core-a-link-that-leaves-the-folder = a link that leaves the folder
core-a-json-number-such-as-125 = a JSON number such as -12.5 or 3e-4
core-key-is-not-known-ignored = key { $a } is not known: ignored
core-no-key = no key { $a }
core-a-number = a number
core-a-name-without-spaces-around-it = a name without spaces around it
core-no-sample = no sample
core-at-least-one = at least one
core-more-cells-like-these-from-here = { $a } more cells like these from here on
core-1-1-or-0-unknown = 1, -1 or 0 (unknown)
core-a-target-of-the-session = a target of the session: { $a }
core-an-empty-cell-while-there-are = an empty cell, while there are several targets
core-target-is-not-declared = target { $a } is not declared
core-fit-heldout-or-excluded = fit, held-out or excluded
core-a-column-for-each-quantity = a column for each quantity
core-one-column-for-each-quantity-remove = one column for each quantity: remove one of the two
core-column-is-not-known-kept-and = column { $a } is not known: kept and ignored
core-joint-does-not-exist = joint { $a } does not exist
core-a-joint-of-the-robot-from = a joint of the robot, from 1 to { $a }
core-a-length = a length
core-an-angle = an angle
core-no-column-for-the-commanded-value = no column for the commanded value of joint { $a }
core-no-column-for-the-measured = no column for the measured { $a }
core-one-of-the-two-columns-of = one of the two columns of a measured direction
core-both-azimuthdeg-and-elevationdeg-or-none = both azimuth_deg and elevation_deg or none
core-all-of-qw-qx-qy-qz = all of qw, qx, qy, qz or none
core-a-line-of-headings = a line of headings
core-an-empty-file = an empty file
core-a-line-of-headings-and-one = a line of headings and one line per sample
core-a-binary-file-it-holds-nul = a binary file (it holds NUL bytes)
core-a-csv-file-headings-and-one = a CSV file: headings and one line per sample
core-numbers-in-the-first-line = numbers in the first line: { $a }
core-a-file-in-utf16 = a file in UTF-16
core-utf8-text-truepose-import-file-as = UTF-8 text; `truepose import FILE --as csv` reads UTF-16
core-bytes-that-are-not-utf8 = bytes that are not UTF-8
core-a-json-document-in-utf8 = a JSON document in UTF-8
core-the-line-ends-after = the line ends after { $a }
core-one-for-each-heading = { $a }, one for each heading
core-more-problems-of-this-kind = { $a } more problems of this kind
core-a-directory = a directory
core-a-device-or-a-pipe = a device or a pipe
core-no-such-folder = no such folder
core-a-file = a file
core-a-folder = a folder
core-a-file-that-can-be-read-to-its-end = a file that can be read to its end
core-a-regular-file = a regular file
core-no-such-file = no such file
core-no-permission-to-read-it = no permission to read it
core-a-file-that-can-be-read = a file that can be read
core-a-path-that-leads-upwards = a path that leads upwards
core-an-absolute-path = an absolute path
core-a-quote-that-nothing-closes = a quote that nothing closes
core-a-second-quote-or-none = a second quote, or none
core-no-table-no-line-of-cells = no table: no line of cells of which one is a number
core-rows-of-cells-between-tabs-semicolons = rows of cells between tabs, semicolons, commas or spaces
core-more-cells-or-rows-like-these = { $a } more cells or rows like these
core-no-row-that-can-be-read = no row that can be read
core-a-number-with-a-decimal-point = a number with a decimal point
core-a-number-with-a-decimal-comma = a number with a decimal comma
core-a-finite-number-or-an-empty = a finite number, or an empty cell where it is missing
core-a-time-seconds-or-1234567 = a time: seconds, or 12:34:56.7
core-no-measurement-falls-into-the-time = no measurement falls into the time of the commands
core-no-measurement-falls-into-a-stop = no measurement falls into a stop of the commands
core-of-measurements-were-taken-at-stops = { $a } of { $b } measurements were taken at stops: all are kept, with their speeds
core-left-out-of-measurements-taken-before = left out { $a } of { $b } measurements, taken before the first or after the last command: { $c }
core-exists-already-force-replaces-it = { $a }: exists already; --force replaces it
core-cancelled-2 = { $a }: cancelled
core-a-pointing-run-for-tpoint-where = a pointing run for TPOINT: where the mount was and where the star was
core-angles-of-the-orientation = Angles of the orientation
core-socket = Socket
core-plane = Plane
core-distances-between-sockets = Distances between sockets
core-axis-of-the-tool-that-points = Axis of the tool that points
core-columns-that-may-be-what-was = columns that may be what was measured: { $a }
core-the-unit-of-the-angles-is = the unit of the angles is not said
core-the-orientation-is-there-as-a = the orientation is there as a quaternion and as angles
core-three-angles-of-an-orientation-and = three angles of an orientation, and neither the order of their axes nor whether these move is said
core-the-angles-turn-in-the-order = the angles turn in the order { $a }, and whether about fixed axes (of the measuring frame) or about moving ones (carried along) is not said
core-lists-read-as-a-table-of = lists, read as a table of { $a } rows and { $b } columns
core-no-header-the-columns-are-taken = no header: the columns are taken as { $a }
core-target = target { $a }
core-fit-the-places-of-the-targets = Fit the places of the targets
core-target-is-elsewhere-from-its-stated = target { $a } is elsewhere: { $b } from its stated place in the tool
core-its-place-is-fitted-moved-by = its place is fitted (moved by { $a }, { $b }, { $c } mm); measure it, or state targets_sigma_mm
core-the-base-model-leaves-as-it = the base model leaves { $a } as it stands and { $b } with the place free; { $c } times likelier
core-the-socket-that-the-target-sat = the socket that the target sat in for all rows, where no column names it: joint values are enough then
core-the-plane-that-was-touched-in = the plane that was touched in all rows, where no column names it: joint values are enough then
core-known-distances-between-sockets-mm-such = known distances between sockets, mm, such as S1-S2=400: one of them sets the size of the robot
core-how-rx-ry-rz-or-euler1 = how rx, ry, rz (or euler1, euler2, euler3) make an orientation: an order of axes and whether they move, such as zyx-moving, xyz-fixed (= zyx-moving) or zyz-moving; rpy (= xyz-fixed); rotvec
core-its-position-is-nearly-singular-the = its position is nearly singular: the correction would turn the tool by { $a }
core-the-search-was-stopped-this-is = the search was stopped: this is what was proven until then
core-the-search-was-stopped-this-is-2 = the search was stopped: this is what was proven until then; { $a }
core-the-search-stopped-at-its-budget = the search stopped at its budget: this is what was proven until then
core-the-search-stopped-at-its-budget-2 = the search stopped at its budget: this is what was proven until then; { $a }
core-a-smooth-curve-over-joint-explains = a smooth curve over joint { $a } explains as much as { $b } together
core-the-remaining-error-is-times-the = the remaining error is { $a } times the floor ({ $b } mm): the measuring frame wanders, or something changes as slowly
core-on-the-session-that-it-came = on the session that it came from the model leaves an RMS error of { $a } mm, and { $b } mm was said: it is not written
core-on-the-session-that-it-came-2 = on the session that it came from the model leaves an RMS error of { $a } mm, and the nominal robot { $b } mm: it is not written
core-the-model-leaves-an-rms-error = the model leaves an RMS error of { $a } mm, and the identification that it began with { $b } mm: it is not written
core-the-model-predicts-no-position-at = the model predicts no position at joint values { $a } (rad, mm): it is not written
core-with-this-the-rms-error-of = with this { $a } the RMS error of '{ $b }' would rise from { $c } to { $d } mm: nothing is written
core-description-of-the-robot = description of the robot

robots-robots = Robots
robots-robots-2 = Robots…
robots-type-a-maker = { $count } common robots with their nominal geometry: type a maker, a model or a kind
robots-hint = such as ur5e, kuka kr 6, scara
robots-find-a-robot = Find a robot
robots-no-robot-has-this-name = No robot has this name
robots-at-its-zero = { $robot } at its zero
robots-kind = kind
robots-reach = reach, load
robots-repeatability = repeatability (ISO 9283)
robots-source = geometry from
robots-not-checked = Not checked against a second source: { $what }
robots-six-joints = six joints
robots-six-joints-offset-wrist = six joints, offset wrist
robots-seven-joints = seven joints
robots-positioner = positioner
robots-rotary-axis = rotary axis
robots-save-robot-file = Save robot file…
robots-save-robot-file-2 = Save robot file
robots-robot-json = Robot (*.json)
robots-a-file-for-sessions = A file that sessions, imports and plans take
robots-simulate = Simulate…
keys-robots = robots of the library
simulation-poses = poses
simulation-joint = joint
simulation-poses-from-one = from 1 to { $most } poses
simulation-a-robot-of-the-library = Poses anywhere in the ranges of the joints, three reflectors at the tool, speeds, loads and a warm-up mixed over them. What is filled in here is what the diagnosis should find
hidden-show = Show what was hidden
hidden-hide = Do not show what was hidden
hidden-hidden = Hidden in this simulation
hidden-nothing = Nothing
hidden-found = found
hidden-identified = identified
hidden-not-found = not found
