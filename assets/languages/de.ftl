# Deutsch

## actions

actions-open-a-session-first = Öffnen Sie zuerst eine Messung
actions-redo = Wiederholen
actions-nothing-was-undone = Es wurde nichts rückgängig gemacht
actions-undo = Rückgängig
actions-nothing-was-changed-yet = Es wurde noch nichts geändert
actions-import = Importieren …
actions-save-session-as = Messung speichern unter …
actions-save-session-to-path = Messung unter Pfad speichern …
actions-compensate-targets = Zielpunkte kompensieren …
actions-save-table = Tabelle speichern …
actions-read-the-file-again = Datei neu einlesen
actions-the-session-is-in-no = Die Messung ist noch in keiner Datei
actions-the-samples-are-in-no = Die Messpunkte haben keine eigene Datei
actions-history-of-the-machine = Verlauf der Maschine …
actions-record-from-an-instrument = Vom Messgerät aufzeichnen …
actions-quit = Beenden
actions-cancel-what-is-running = Laufenden Vorgang abbrechen
actions-nothing-is-running = Es läuft nichts
actions-choose-a-sample = Wählen Sie einen Messpunkt in einem Diagramm oder in der Tabelle
actions-preferences = Einstellungen …
actions-workspace-from-above = Arbeitsraum von oben
actions-workspace-from-the-side = Arbeitsraum von der Seite
actions-workspace-from-the-front = Arbeitsraum von vorn
actions-deviation-around-the-angle = Abweichung über den Winkel (polar)
actions-workspace-in-3-d = Arbeitsraum in 3-D
actions-show-everything-in-the-plots = Alles in den Diagrammen zeigen
actions-this-robot-has-no-such = Dieser Roboter hat keinen solchen Schritt
actions-about-truepose = Über truepose
actions-all-commands = Alle Befehle …
actions-include-again = { $what } wieder einschließen
actions-exclude = { $what } ausschließen
actions-stop-following-the-file = Datei nicht mehr verfolgen
actions-lengths-in-m = Längen in µm
actions-lengths-in-inches = Längen in Zoll
actions-lengths-in-mm = Längen in mm
actions-angles-in-radians = Winkel in rad
actions-angles-in-mrad = Winkel in mrad
actions-angles-in-arcsec = Winkel in Winkelsekunden
actions-angles-in-degrees = Winkel in Grad
actions-light = Hell
actions-dark = Dunkel
actions-hide-results = Ergebnisse ausblenden
actions-show-results = Ergebnisse einblenden

## common

common-identify-the-robot-first = Identifizieren Sie zuerst den Roboter
common-open = Öffnen …
common-new-by-simulation = Neu durch Simulation …
common-save-session = Messung speichern
common-save-model = Modell speichern …
common-report-details = Angaben zum Bericht …
common-report = Bericht …
common-identify = identifizieren
common-identify-2 = Identifizieren
common-run-diagnosis = Diagnose starten
common-3-d-view-isometric = 3-D-Ansicht, isometrisch
common-3-d-view = 3-D-Ansicht von vorn
common-3-d-view-from-the-side = 3-D-Ansicht von der Seite
common-3-d-view-from-above = 3-D-Ansicht von oben
common-glossary = Glossar
common-keyboard-and-mouse = Tastatur und Maus
common-follow-the-file-as = Wachsende Datei verfolgen
common-time = Zeit
common-joints = Gelenke
common-table = Tabelle
common-before = vorher
common-after = nachher
common-effect = Effekt
common-without = ohne ihn
common-moving-positive = Bewegung positiv
common-negative = negativ
common-noise-alone = nur Rauschen
common-samples = Messpunkte
common-noise = Rauschen
common-degrees = Grad
common-radians = Radiant
common-there-is-no-such-region = diese Region gibt es nicht
common-tolerance = Toleranz
common-from = von
common-to = bis
common-step = Schrittweite
common-corrected = korrigiert
common-cancel = Abbrechen
common-done = Fertig
common-excluded = ausgeschlossen
common-session = Messung
common-decimal-sign = Dezimalzeichen
common-lengths = Längen in
common-none = keine
common-which-robot-was-measured = Welcher Roboter gemessen wurde
common-tool = Werkzeug
common-save-table = Tabelle speichern
common-save-model-2 = Modell speichern
common-save-measuring-list = Messliste speichern
common-save-report = Bericht speichern
common-save-picture = Bild speichern
common-save-corrected-file = Korrigierte Datei speichern
common-instrument = Messgerät
common-targets-and-programs = Zielpunkte und Programme
common-table-2 = Tabelle
common-and-more = und { $more } weitere
common-the-simulation-needs-other-numbers = Die Simulation braucht andere Zahlen
common-deviation = Abweichung
common-direction = Richtung
common-export = Export
common-chart = Diagramm
common-copy-table = Tabelle kopieren
common-within-tolerance = in der Toleranz
common-noise-floor = Rauschgrenze
common-testable-effects = prüfbare Effekte
common-of = { $yes } von { $no }
common-is-not-there-any-more = { $name } ist nicht mehr da
common-not-yet = noch nicht
common-joint = Gelenk
common-not-correctable-by-joint-commands = durch Gelenkbefehle nicht korrigierbar
common-robot = Roboter
common-rms-error = RMS-Fehler
common-show-these-samples = Diese Messpunkte zeigen
common-estimated = geschätzt
common-held-out = zurückgehalten
common-the-fit-did-not-converge = die Anpassung ist nicht konvergiert: { $stopped }
common-sample = Messpunkt { $sample }
common-identified = identifiziert
common-searching = Suche läuft
common-continue-to-export = Weiter zum Export
common-regions = Regionen
common-recent-files = Zuletzt geöffnet
common-forget = { $name } vergessen
common-measured = gemessen
common-there-are-no-samples = es gibt keine Messpunkte zu zeichnen
common-continue-to-identify = Weiter zum Identifizieren
common-results = Ergebnisse
common-instrument-2 = Messgerät
common-open-2 = Öffnen
common-workspace = Arbeitsraum
common-dismiss = Schließen
common-within = innerhalb
common-outside = außerhalb
common-vectors = Vektoren
common-heat-map = Farbkarte
common-load = Last
common-temperature = Temperatur
samples =
    { $count ->
        [one] { $count } Messpunkt
       *[other] { $count } Messpunkte
    }
regions =
    { $count ->
        [one] { $count } Region
       *[other] { $count } Regionen
    }
effects =
    { $count ->
        [one] { $count } Effekt
       *[other] { $count } Effekte
    }
nothing = {""}

## keys

keys-redo = wiederholen
keys-undo = rückgängig machen
keys-open-the-last-file-again = die letzte Datei wieder öffnen
keys-open-a-file = eine Datei öffnen
keys-import-what-an-instrument-wrote = Datei eines Messgeräts importieren
keys-first-example = erstes Beispiel
keys-second-example = zweites Beispiel
keys-third-example = drittes Beispiel
keys-new-by-simulation = neu durch Simulation
keys-save-session-as = Messung speichern unter
keys-save-session = Messung speichern
keys-save-session-to-a-path = Messung unter einem Pfad speichern
keys-save-model = Modell speichern
keys-correct-targets-or-a-program = Zielpunkte oder ein Programm korrigieren
keys-save-table = Tabelle speichern
keys-save-the-report = Bericht speichern
keys-read-the-file-again = Datei neu einlesen
keys-follow-the-file-or-stop = Datei verfolgen oder damit aufhören
keys-report-details = Angaben zu Kunde und Maschine
keys-history-of-the-machine = die Messungen dieser Maschine vergleichen
keys-record-from-an-instrument = von einem Messgerät aufzeichnen
keys-quit = beenden
keys-search-for-what-is-missing = Diagnose starten
keys-cancel = abbrechen
keys-exclude-the-chosen-samples-or = gewählte Messpunkte ausschließen oder wieder einschließen
keys-preferences = Einstellungen
keys-other-unit-of-angles = andere Winkeleinheit
keys-next-unit-of-lengths = nächste Längeneinheit
keys-light-or-dark = hell oder dunkel
keys-results-or-more-room = Ergebnisse oder mehr Platz für die Diagramme
keys-workspace-from-above = Arbeitsraum von oben
keys-workspace-from-the-side = Arbeitsraum von der Seite
keys-workspace-from-the-front = Arbeitsraum von vorn
keys-deviation-around-the-angle-polar = Abweichung über den Winkel (polar)
keys-workspace-in-3-d = Arbeitsraum in 3-D
keys-fit-the-plots-view = Diagramme einpassen
keys-the-same = dasselbe
keys-first-step = erster Schritt
keys-second-step = zweiter Schritt
keys-third-step = dritter Schritt
keys-fourth-step = vierter Schritt
keys-fifth-step-where-there-are = fünfter Schritt, wo es Regionen gibt
keys-about-truepose = über truepose
keys-glossary = Glossar
keys-this-list = diese Liste
keys-all-commands-by-a-word = alle Befehle, nach einem Wort ihres Namens
keys-move-the-boundary-that-has = die Grenze mit dem Fokus verschieben
keys-move-it-further = weiter verschieben
keys-orbit-and-zoom-the-3 = die 3-D-Ansicht mit dem Fokus drehen und zoomen
keys-next-control-the-one-before = nächstes, voriges Bedienelement
keys-space-or-enter = Leertaste oder Enter
keys-press = betätigen
keys-larger-smaller-usual-text = Text größer, kleiner, normal
keys-close-a-sheet = ein Fenster schließen
keys-the-mouse-in-the-plots = Die Maus in den Diagrammen

## over

over-no-sample-has-a-joint = Kein Messpunkt hat einen Gelenkwert
over-every-sample-needs-its-q1 = Jeder Messpunkt braucht seine Zelle q1
over-no-time-was-logged = Es wurde keine Zeit aufgezeichnet
over-a-column-time-s-would = Eine Spalte time_s würde zeigen, ob die Abweichung während der Messung driftet und wann jemand das Stativ berührt hat
over-no-load-was-logged = Es wurde keine Last aufgezeichnet
over-a-column-load-kg-would = Eine Spalte load_kg würde zeigen, ob der Arm unter seiner Last nachgibt: Messen Sie einige Posen leer und dieselben beladen
over-no-temperature-was-logged = Es wurde keine Temperatur aufgezeichnet
over-a-column-temperature-c-would = Eine Spalte temperature_c würde zeigen, ob die Abweichung der Temperatur der Maschine folgt
over-the-joints-motion-was-not = Die Bewegung des Gelenks wurde nicht aufgezeichnet
over-columns-speed1-deg-s = Spalten speed1_deg_s und dir1 würden zeigen, wie die Abweichung der Bewegung folgt
over-time-since-the-first-sample = Zeit seit dem ersten Messpunkt
over-speed-of = Geschwindigkeit von { $joint }
over-travel-of-since-it-reversed = Weg von { $joint } seit der Umkehr

## by-joint

by-joint-deviation-by-joint = Abweichung je Gelenk
by-joint-the-deviation-over-every-joint = Die Abweichung über jedem Gelenk, jeweils vom kleinsten bis zum größten Wert. Eine Kurve in einem Feld ist ein Fehler dieses Gelenks
by-joint-every-sample-needs-its-joint = Jeder Messpunkt braucht seine Gelenkwerte und das Gemessene
by-joint-no-sample-to-show = Kein Messpunkt zu zeigen
by-joint-each-over-the-range = Gelenk, jeweils über den gezeigten Bereich
by-joint-deviation-by-joint-2 = Abweichung { $name } je Gelenk
by-joint-deviation-by-joint-3 = Abweichung je Gelenk, { $name }
by-joint-deviation-of-samples-over-joints = Abweichung { $name } von { $samples } Messpunkten über { $joints } Gelenken, { $from } bis { $to }

## correction

correction-correction-table = Korrekturtabelle
correction-this-format-describes-the-robot = Dieses Format beschreibt den Roboter selbst und hat keine Tabelle
correction-correction-table-as-a-curve = Korrekturtabelle als Kurve
correction-the-same-for-both-directions = für beide Richtungen gleich
correction-solid-moving-positive-dashed-moving = durchgezogen: Bewegung positiv · gestrichelt: Bewegung negativ
correction-correction-table-2 = Korrekturtabelle
correction-correction = Korrektur, { $unit }

## deviation

deviation-angle = Winkel
deviation-deviation-over-angle = Abweichung über dem Winkel
deviation-deviation-over-time = Abweichung über der Zeit
deviation-deviation-over-load = Abweichung über der Last
deviation-deviation-over-temperature = Abweichung über der Temperatur
deviation-deviation-chart = Diagramm der Abweichung, { $component }
deviation-chart = Diagramm { $chart }, { $component }
deviation-deviation-over = Abweichung { $name } über { $label }
deviation-to = { $component } zu { $first }
deviation-the-never-changes = { $what } ändert sich nie
deviation-from-the-smallest = in jeder Spalte vom kleinsten bis zum größten Wert
deviation-one-sample-has-no-value = ein Messpunkt hat keinen Wert und wird nicht gezeigt
deviation-samples-have-no-value = { $n } Messpunkte haben keinen Wert und werden nicht gezeigt
deviation-to-2 = { $from } bis { $to }
deviation-no-sample-to-show = kein Messpunkt zu zeigen
deviation-deviation-of-samples-over = Abweichung { $component } von { $samples } Messpunkten über { $label } von { $from } bis { $to }
deviation-tolerance = , Toleranz { $tolerance }

## curve

curve-effects-own-curve = Kurve des Effekts
curve-curve = Kurve von { $curve }, { $component }
curve-there-is-no-curve = Es gibt keine Kurve zu zeigen
curve-run-the-diagnosis-again-what = Starten Sie die Diagnose erneut: Das Gefundene gehört zu anderen Messpunkten
curve-without = ohne { $what }
curve-what-it-does = seine Wirkung
curve-residual-without-and-what = Residuum { $component } ohne { $what } und dessen Wirkung
curve-what-is-left-without-all = was ohne { $curve } bleibt; alles andere wie angepasst
curve-it-depends-on-the-pose = hängt auch von der Pose ab: sein Wert an jedem Messpunkt
curve-a-set-up-error = ein Aufbaufehler ist noch nicht korrigiert und zeigt sich auch hier
curve-over-it-moves-the-deviation = { $curve } über { $label }: verschiebt die Abweichung { $component } von { $from } bis { $to }; ohne den Effekt bleiben { $before } (quadratisches Mittel), mit ihm { $after }

## chart-gap

chart-gap = RMS
chart-gap-by-step = RMS-Fehler Schritt für Schritt
chart-gap-nothing-is-identified-yet = noch nichts identifiziert
chart-gap-rms-over-the-fitted-samples = RMS über die angepassten Messpunkte
chart-gap-by-step-2 = RMS-Fehler Schritt für Schritt: { $steps }

## histogram

histogram-bars-as-wide-as = Balken so breit, wie es die Streuung der Messpunkte verlangt
histogram-histogram = Histogramm
histogram-histogram-2 = Histogramm
histogram-histogram-3 = Histogramm, { $component }
histogram-no-sample-can-be-counted = Kein Messpunkt lässt sich zählen
histogram-every-sample-lacks-a-joint = Jedem Messpunkt fehlt ein Gelenkwert oder eine Koordinate
histogram-click = Klick
histogram-marks-them = markiert sie
histogram-tolerance = {" "}Toleranz{" "}
histogram-samples-by-deviation = Messpunkte nach Abweichung { $name }
histogram-deviation = Abweichung { $name }, { $units }
histogram-within = in { $sign }{ $tolerance }: { $counts } von { $all }
histogram-one-lies-beyond-the-ends = einer liegt jenseits der Enden
histogram-lie-beyond-the-ends = { $n } liegen jenseits der Enden
histogram-wide = { $width } { $unit } breite { $rule }
histogram-most = die meisten, { $bin }, von { $from } bis { $to }
histogram-how-many-samples-have-which = wie viele Messpunkte welche Abweichung { $component } haben

## orders

orders-orders = Ordnungen
orders-order-spectrum = Ordnungsspektrum
orders-order-spectrum-2 = Ordnungsspektrum, { $component }
orders-orders-are-cycles-per-turn = Ordnungen sind Perioden je Umdrehung. Wählen Sie ein Drehgelenk
orders-slides = { $name } ist ein Schubgelenk
orders-too-few-different-angles = Zu wenige verschiedene Winkel
orders-an-order-shows-where = Eine Ordnung zeigt eine Welle, die mit jeder Umdrehung wiederkehrt: Messen Sie dreißig oder mehr Winkel, verteilt über den ganzen Bereich des Gelenks
orders-usual-cause = übliche Ursache
orders-noise = Rauschen, { $name }
orders-order = Ordnung { $order }
orders-deviation-by-order-over = Abweichung { $name } nach Ordnung über { $joint }
orders-cycles-per-turn = Perioden je Umdrehung von { $joint }
orders-amplitude = Amplitude, { $unit }
orders-too-few-samples-to-say = zu wenige Messpunkte, um das Rauschen anzugeben
orders-order-2 = Ordnung { $order }{ $cause } mit { $amplitude }
orders-nothing-above-the-noise = nichts über dem Rauschen
orders-orders-of-the-deviation-before = { $orders } Ordnungen der Abweichung { $component }; vorher: { $before }
orders-after = ; nachher: { $after }
orders-noise-stays-below-the-line = Rauschen bleibt in 99 von 100 Messungen unter der Linie
orders-range-orders-nearer-than-cannot = Bereich { $range }°: Ordnungen näher als { $apart } sind nicht zu trennen
orders-and-order-1-cannot-be = , und Ordnung 1 ist nicht zu sehen
orders-and-orders-up-to-cannot = , und Ordnungen bis { $n } sind nicht zu sehen
orders-eccentricity = Exzentrizität
orders-two-cycle = zweiperiodisch
orders-gear = Getriebe

## quantiles

quantiles-quantiles = Quantile
quantiles-normal-quantiles = Normalquantile
quantiles-each-samples-residual-over = Das Residuum jedes Messpunkts über dem Platz, den Rauschen ihm gäbe. Auf der Geraden ist nur Rauschen; abbiegende Enden sind Ausreißer, ein Knick oder eine Stufe in der Mitte ist ein Fehler, der dem Modell fehlt
quantiles-nothing-to-compare = Nichts, was mit der Normalverteilung zu vergleichen wäre
quantiles-choose-a-component-that-has = Wählen Sie eine Komponente mit Vorzeichen, von vier oder mehr Messpunkten
quantiles-normal-quantiles-2 = Normalquantile, { $name }
quantiles-residuals-of-samples-over-normal = Residuen { $name } von { $samples } Messpunkten über Normalquantilen; die mittlere Hälfte streut wie Rauschen von { $sigma }
quantiles-residuals-over-normal-quantiles = Residuen { $name } über Normalquantilen
quantiles-what-noise-alone-would-be = was reines Rauschen wäre, σ
quantiles-the-line-has-the-slope = die Gerade hat die Steigung σ = { $sigma }

## boundary-entry

boundary-entry-milliradians = Milliradiant
boundary-entry-seconds-of-arc = Winkelsekunden
boundary-entry-the-angle-is-missing-type = der Winkel fehlt; geben Sie ihn in { $name } ein, etwa { $example }
boundary-entry-is-no-angle-type = „{ $text }“ ist kein Winkel; geben Sie eine Zahl in { $name } ein, etwa { $example }
boundary-entry-a-boundary-is-an-angle = eine Grenze ist ein Winkel; geben Sie eine Zahl ein
boundary-entry-is-outside-of-the-joints = { $at } liegt außerhalb des Gelenkbereichs { $range }; { $same } ist dieselbe Richtung: geben Sie das ein
boundary-entry-is-outside-of-the-joints-range = { $at } liegt außerhalb des Gelenkbereichs { $range }; geben Sie einen Winkel darin ein
boundary-entry-at-most = höchstens { $from }
boundary-entry-at-least = mindestens { $to }
boundary-entry-region-would-overlap-region-type = Region { $next } würde Region { $other } überlappen, { $from } … { $to }; geben Sie { $free } ein oder vereinigen Sie die beiden
boundary-entry-type-or-more = geben Sie { $least } oder mehr ein
boundary-entry-type-or-less = geben Sie { $most } oder weniger ein
boundary-entry-region-would-begin-and-end = Region { $name } würde bei { $from } beginnen und enden; { $instead }
boundary-entry-region-would-be-wide-less = Region { $name } wäre { $width } breit, weniger als { $least }; { $instead }
boundary-entry-region-would-run-from-over = Region { $name } würde von { $from } über { $limit } bis { $to } reichen; das kann keine Region: Legen Sie zwei an, eine bis { $first } und eine ab { $second }
boundary-entry-region-would-begin-at-after = Region { $name } würde bei { $from } beginnen, nach ihrem Ende bei { $to }; { $instead }

## compensated

compensated-neither-its-ending-nor-its = { $path }: Weder Endung noch Inhalt sagen, was es ist; erwartet { $all }

## division

division-one-region-nowhere-does = Eine Region: Nirgends ändert sich die Abweichung um mehr als das Rauschen
division-regions-a-boundary-where = { $n } Regionen: eine Grenze, wo sich die Abweichung um mehr als das Rauschen ändert
division-they-leave-even-ones = { $first }. Sie lassen { $left } übrig, { $n } gleichmäßige { $even }

## edit

edit-nothing-was-measured-yet-open = es wurde noch nichts gemessen: Öffnen Sie eine Messung dieses Roboters
edit-regions-are-for-a-single = Regionen gibt es nur für ein einzelnes Drehgelenk
edit-a-tolerance-is-a-number = eine Toleranz ist eine Zahl über 0
edit-a-table-needs-a-joint = eine Tabelle braucht ein Gelenk des Roboters und eine Schrittweite über 0
edit-there-is-no-such-effect = diesen Effekt gibt es nicht
edit-no-sample-would-be-left = es bliebe kein Messpunkt zum Anpassen
edit-no-sample-would-be-left-2 = es bliebe kein Messpunkt
edit-open-session = Messung öffnen
edit-open-model = Modell öffnen
edit-divide-into-regions = in Regionen teilen
edit-move-boundary = Grenze verschieben
edit-divide-adaptively = adaptiv teilen
edit-keep-the-regions = Regionen behalten
edit-split-region = Region teilen
edit-merge-regions = Regionen vereinigen
edit-delete-region = Region löschen
edit-rename-region = Region umbenennen
edit-take-regions-from-session = Regionen der Messung übernehmen
edit-choose-method = Verfahren wählen
edit-choose-effects = Effekte wählen
edit-set-tolerance = Toleranz setzen
edit-choose-table = Tabelle wählen
edit-add-to-model = zum Modell hinzufügen
edit-switch-effect = Effekt einschalten
edit-switch-effect-off = Effekt ausschalten
edit-edit-robot-and-instrument = Roboter und Messgerät bearbeiten
edit-exclude-samples = Messpunkte ausschließen
edit-include-samples = Messpunkte einschließen
edit-mend-data = Daten berichtigen
edit-restore = wiederherstellen
edit-the-boundary-cannot-be-moved = dorthin lässt sich die Grenze nicht verschieben
edit-the-region-is-too-narrow = die Region ist zu schmal zum Teilen
edit-no-region-begins-where-this = keine Region beginnt, wo diese endet; geben Sie ihr Ende zuerst bei der nächsten ein
edit-the-last-region-stays-without = die letzte Region bleibt: Ohne eine wird nichts korrigiert
edit-a-region-needs-a-name = eine Region braucht einen Namen
edit-another-region-is-called-choose = eine andere Region heißt { $name }; wählen Sie einen anderen Namen

## loaded-session

loaded-session-length = Länge
loaded-session-tangential = tangential
loaded-session-radial = radial
loaded-session-axial = axial

## search

search-set-up-errors = Aufbaufehler
search-noise-outliers-candidates = Rauschen, Ausreißer, Kandidaten
search-search = Suche
search-other-explanations = andere Erklärungen
search-poses-to-measure-next = nächste Messposen
search-the-search-was-cancelled = die Suche wurde abgebrochen

## setup

setup-a-joint-needs-a-name = ein Gelenk braucht einen Namen
setup-another-joint-is-called = ein anderes Gelenk heißt { $form }
setup-the-noise-is-a-number = das Rauschen ist eine Zahl über 0
setup-a-reflector-needs-a-name = ein Reflektor braucht einen Namen
setup-another-reflector-is-called = ein anderer Reflektor heißt { $name }
setup-limits-run-from-the-smaller = Grenzen gehen vom kleineren zum größeren Wert
setup-a-mass-is-0-kg = eine Masse ist 0 kg oder mehr
setup-robot-and-instrument = Roboter und Messgerät
setup-joint = Gelenk { $k }, { $joints }
setup-tool-and-gravity = Werkzeug und Schwerkraft
setup-reflectors = Reflektoren
setup-not-taken-over-while-something = Wird nicht übernommen, solange etwas falsch ist
setup-back-to-what-was-there = Zurück zum vorigen Stand
setup-name-of-joint = Name von Gelenk { $n }
setup-turns = dreht
setup-slides = schiebt
setup-axis-direction-at-home = Achse, Richtung in Grundstellung
setup-axis = Achse { $n }
setup-a-point-on-it-mm = ein Punkt darauf, mm
setup-point = Punkt { $n }
setup-limits-of-joint = Grenzen von Gelenk { $n }, { $unit }
setup-limit = Grenze { $n }
setup-mass-of-link-kg = Masse von Glied { $n }, kg
setup-mass = Masse { $n }
setup-its-centre-at-home-mm = Schwerpunkt in Grundstellung, mm
setup-centre = Schwerpunkt { $n }
setup-tool-at-home-mm = Werkzeug in Grundstellung, mm
setup-orientation-quaternion-w-x-y = Orientierung, Quaternion w x y z
setup-orientation = Orientierung
setup-gravity-is-known-m-s = Schwerkraft bekannt, m/s²
setup-gravity = Schwerkraft
setup-in-the-tool-frame-mm = im Werkzeugsystem, mm
setup-name-of-reflector = Name von Reflektor { $n }
setup-reflector = Reflektor { $n }
setup-remove-this-reflector = Diesen Reflektor entfernen
setup-add-a-reflector = Reflektor hinzufügen
setup-name-of-the-instrument = Name des Messgeräts
setup-noise-one-mm = Rauschen, ein σ, mm
setup-unknown = unbekannt
setup-one-number = eine Zahl
setup-noise = Rauschen

## simulation

simulation-nominal-radius = Sollradius
simulation-zero-offset = Nullpunktverschiebung
simulation-length-error = Längenfehler
simulation-this-field-needs-a-number = dieses Feld braucht eine Zahl
simulation-the-radius-has-to-be = der Radius muss über 0 mm liegen
simulation-the-tolerance-cannot-be-below = die Toleranz kann nicht unter 0 liegen
simulation-the-sweep-has-to-run = der Schwenk muss vom kleineren zum größeren Winkel gehen
simulation-the-step-has-to-be = die Schrittweite muss über 0° liegen
simulation-that-is-more-than = das sind mehr als eine Million Posen; nehmen Sie eine größere Schrittweite
simulation-the-noise-cannot-be-below = das Rauschen kann nicht unter 0 liegen
simulation-every-field-needs-a-number = jedes Feld braucht eine Zahl
simulation-new-by-simulation = Neu durch Simulation
simulation-a-lamp-on-one-turning = Eine Leuchte an einer Drehachse, gemessen mit einem Tracker. Was hier eingetragen wird, soll die Identifikation finden
simulation-what-stands-in-colour-above = Was oben farbig steht, muss zuerst eine andere Zahl werden
simulation-simulate = Simulieren
simulation-robot = Roboter
simulation-tolerance = Toleranz
simulation-sweep = Schwenk
simulation-there-and-back = hin und zurück
simulation-seed = Startwert
simulation-other-effects = Weitere Effekte
simulation-remove = Entfernen
simulation-add-an-effect = Effekt hinzufügen …
simulation-add-an-effect-2 = Effekt hinzufügen

## about

about-calibrates-a-robot-at-commissioning = Kalibriert einen Roboter bei der Inbetriebnahme: findet, wo Messung und Simulation voneinander abweichen, und schreibt, was die Steuerung braucht
about-everything-in-this-window-can = Alles in diesem Fenster geht auch im Terminal: truepose --help
about-type-inter-by-the-inter = Schrift: Inter, von den Autoren des Inter-Projekts, SIL Open Font License 1.1
about-version = Version { $version }

## compensation

compensation-compensate = { $name } kompensieren
compensation-save-corrected-file = Korrigierte Datei speichern …
compensation-load-where-the-file-says = Last, wo die Datei keine angibt
compensation-the-measuring-frame = das Messsystem ist die Basis des Roboters (--measured-frame)
compensation-read-as = gelesen als
compensation-of = { $corrected } von { $targets }
compensation-targets-corrected = korrigierte Zielpunkte
compensation-rms-position-error = RMS-Positionsfehler
compensation-largest-position-error = größter Positionsfehler
compensation-lines-that-change = Geänderte Zeilen
compensation-line = Zeile
compensation-is-left-as = { $name } bleibt, wie er ist: { $left }
compensation-not-corrected = nicht korrigiert: { $says }
compensation-line-column = Zeile { $line }, Spalte { $column }: { $says }
compensation-and-more-all-of-them = und { $more } weitere: Alle stehen in der Datei neben der gespeicherten

## import

import-not-imported = nicht importiert
import-point-name = Punktname
import-group-of-points = Punktgruppe
import-reflector = Reflektor
import-unit-as-chosen = { $axis }, Einheit wie gewählt
import-joint-commanded = Gelenk { $n } Sollwert, { $sign }
import-joint-read-back = Gelenk { $n } Istwert, { $sign }
import-side-joint-came = Anfahrrichtung von Gelenk { $n }
import-speed-of-joint-s = Geschwindigkeit von Gelenk { $n }, °/s
import-load-kg = Last, kg
import-temperature-c = Temperatur, °C
import-time-s = Zeit, s
import-setup-of-the-instrument = Aufstellung des Messgeräts
import-fit-held-out-or-excluded = angepasst, zurückgehalten oder ausgeschlossen
import-orientation = Orientierung { $part }
import-as-you-said = nach Ihrer Angabe
import-for-certain = sicher
import-guessed-from-the-header = aus der Kopfzeile geschlossen
import-guessed-from-the-values = aus den Werten geschlossen
import-columns-what-each-is-how = Spalten: Bedeutung, woher bekannt, Überschrift, erste Zeilen
import-before-the-table = Vor der Tabelle: { $lines }
import-of-columns-are-guessed-compare = { $guesses } von { $columns } Spalten sind vermutet: Vergleichen Sie sie mit den ersten Zeilen
import-the-columns-are-right = Die Spalten stimmen
import-meaning-of-column = Bedeutung von Spalte { $k }
import-where-the-robot-was-sent = Sollpositionen des Roboters, wenn sie nicht in der Tabelle stehen
import-file-of-the-commands = Datei der Sollwerte
import-a-table-with-q1-deg = eine Tabelle mit q1_deg, … und vielleicht name, time_s, dir1, load_kg
import-by-order = nach Reihenfolge
import-by-name = nach Name
import-by-time = nach Zeit
import-matched = Zuordnung
import-as-it-suits = automatisch
import-the-mean-of-each-stop = Mittel jedes Halts
import-all = alle
import-samples-are = Messpunkte sind
import-clocks-apart = Uhrenversatz
import-found-from-the-motion = aus der Bewegung
import-typed = eingegeben
import-seconds-to-add = Sekunden, die zur gemessenen Zeit kommen
import-the-measured-clock-needs-s = Die Messuhr braucht { $offset_s } s, um zu den Sollwerten zu passen, ± { $sigma } s (95 %); { $rms } mm bleiben
import-with-s-added-mm-are = Mit { $offset_s } s bleiben { $rms } mm zwischen Bahn und Messung
import-points-known-in-the-base = Im Basissystem bekannte Punkte, wenn das Messgerät ein eigenes System hat
import-file-of-the-known-points = Datei der bekannten Punkte
import-a-table-with-name-x = eine Tabelle mit name, x_mm, y_mm, z_mm; dieselben Namen wie in der Messdatei
import-fit-a-scale-too = auch einen Maßstab anpassen
import-points-fit-with-mm-root = { $used } Punkte passen auf { $rms } mm (quadratisches Mittel)
import-excluded-measured-or-surveyed-wrongly = , { $left_out } ausgeschlossen: falsch gemessen oder eingemessen oder seither bewegt
import-scaled-by-ppm = skaliert mit { $scale } ({ $ppm } ppm)
import-point = Punkt
import-off-by-mm = Abweichung, mm
import-in-x = in x
import-in-y = in y
import-in-z = in z
import-reflectors-in-the-tool-frame = Reflektoren im Werkzeugsystem, wenn es mehrere gibt
import-file-of-the-reflectors = Datei der Reflektoren
import-a-table-with-name-x-mm = eine Tabelle mit name, x_mm, y_mm, z_mm; ohne sie sitzt einer im Werkzeugursprung
import-rows = { $rows } Zeilen
import-separated = getrennt durch { $separator }
import-header-in-line = Kopfzeile in Zeile { $line }
import-no-header = keine Kopfzeile
import-unit = Einheit: { $found }
import-name-of-the-session = Name der Messung
import-source = Quelle
import-what-wrote-the-file = Was die Datei geschrieben hat
import-commas = Kommas
import-semicolons = Semikolons
import-tabs = Tabulatoren
import-spaces = Leerzeichen
import-separated-2 = Getrennt durch
import-header = Kopfzeile
import-as-the-headings-say = laut Kopfzeile
import-angles = Winkel in
import-as-the-file-says = laut Datei
import-inches = Zoll
import-y-points-up-turn = y zeigt nach oben: so drehen, dass z es tut
import-joint-measured = Gemessenes Gelenk
import-as-found = wie gefunden
import-in-line = in Zeile
import-line-of-the-header = Zeile der Kopfzeile
import-take = Auswahl
import-choose-it-in-the-table = Wählen Sie es oben in der Tabelle
import-it = Es ist { $answer }
import-import = { $name } importieren
import-import-2 = Importieren
import-looking-at-the-file-was = Das Lesen der Datei wurde abgebrochen
import-look-again = Erneut lesen
import-stop-looking = Lesen abbrechen
import-warning = Warnung:{" "}
import-error = Fehler:{" "}
import-choose = Wählen …
import-choose-2 = Wählen: { $label }
import-use-which-lies-beside = { $file } verwenden, die danebenliegt
import-taken-by-its-name = Übernommen, weil sein Name der der Datei ist
import-use = { $file } verwenden: { $label }
import-what-the-import-brings = Was der Import bringt
import-to-fix = Zu klären
import-mm-from-the-nominal-robot = , { $rms } mm vom Sollroboter
import-matched-by-unmatched-measured-commanded = ; zugeordnet nach { $id }; ohne Partner: { $lonely_measurements } gemessen, { $lonely_commands } Sollwerte
import-that-of-the-open-session = der der offenen Messung, { $here }
import-that-of-the-example = der des Beispiels { $example }
import-the-one-in-this-file = der in dieser Datei
import-file-of-the-robot = Datei des Roboters
import-a-robot-a-session-or = ein Roboter, eine Messung oder eine URDF-Datei
import-base = Basis
import-link-of-the-base = Glied der Basis
import-tip = Ende
import-link-of-the-tool = Glied des Werkzeugs
import-name-of-a-link = Name eines Glieds
import-one-axis-that-turns-typed = eine Drehachse, hier eingegeben
import-name = Name
import-name-of-the-robot = Name des Roboters
import-axis-at-home = Achse in Grundstellung
import-axis = Achse
import-point-on-it-mm = Punkt darauf, mm
import-point-2 = Punkt
import-tool-at-home-mm = Werkzeug, mm
import-travel = Verfahrweg, °
import-travel-2 = Verfahrweg
import-gravity-points-along-z = Schwerkraft zeigt nach −z
import-one-joint-that-turns = ein Drehgelenk
import-one-joint-that-slides = ein Schubgelenk
import-joints-of-which-turn = { $count } Gelenke, davon { $turns } Drehgelenke
import-tool-mm-from-the-base = { $robot }: { $joints }, Werkzeug { $reach } mm von der Basis
import-looking-at-the-file = Datei wird gelesen …
import-a-table-of-at-most = eine Tabelle von höchstens 1000 MB: Exportieren Sie weniger Punkte oder teilen Sie sie
import-answer-what-is-asked-above = Beantworten Sie zuerst die Fragen oben
import-the-file-cannot-be-read = So lässt sich die Datei nicht lesen
import-look-at-the-columns-above = Prüfen und bestätigen Sie die Spalten oben
import-give-the-session-a-name = Geben Sie der Messung einen Namen
import-say-whose-robot-was-measured = Geben Sie an, welcher Roboter gemessen wurde
import-say-which-file-the-robot = Geben Sie an, in welcher Datei der Roboter steht
import-the-robot-cannot-be-read = So lässt sich der Roboter nicht lesen
import-the-travel-runs = der Verfahrweg geht vom kleineren zum größeren Wert
import-the-tool-lies = das Werkzeug liegt auf der Achse: Geben Sie seinen Ort in Grundstellung neben der Achse an
import-a-robot-needs-a-name = ein Roboter braucht einen Namen
import-and-more = und { $more } weitere
import-clocks-apart-2 = „Uhrenversatz“
import-matched-by-order-or = „Zuordnung“ nach Reihenfolge oder Name
import-matched-by-name-or = „Zuordnung“ nach Name oder Zeit
import-matched-by-order = „Zuordnung“ nach Reihenfolge
import-matched-2 = „Zuordnung“
import-samples-are-all = „Messpunkte sind“ alle
import-samples-are-2 = „Messpunkte sind“
import-a-file-of-commands = eine Datei der Sollwerte mit
import-a-file-of-commands-2 = eine Datei der Sollwerte
import-a-file-of-reflectors = eine Datei der Reflektoren mit
import-a-file-of-known-points = eine Datei bekannter Punkte
import-angles-2 = „Winkel in“
import-separated-3 = „Getrennt durch“
import-decimal-sign = „Dezimalzeichen“
import-the-columns-above-as = die Spalten oben als
import-y-points-up = „y zeigt nach oben“
import-fit-a-scale = „Maßstab anpassen“
import-joint-measured-2 = „Gemessenes Gelenk“
import-lengths = „Längen in“

## palette

palette-what-to-do = was zu tun ist
palette-command = Befehl
palette-no-command-has-this = Kein Befehl hat das im Namen

## path

path-the-samples-are-written-beside = Die Messpunkte werden daneben als CSV-Datei gleichen Namens geschrieben
path-path-to-save = Pfad zum Speichern
path-in-the-folder = { $name }, im Ordner { $folder }
path-replace-the-file-if = vorhandene Datei ersetzen
path-save = Speichern
path-a-file-that-says-what = Eine Datei, die die Tabelle erklärt, wird danebengeschrieben
path-the-model-can-be-exported = Das Modell kann später exportiert und geprüft werden
path-a-csv-table = Eine CSV-Tabelle mit den Spaltennamen der Messung, als Nächstes zu messen
path-a-name-that-ends = Ein Name, der auf .html oder .pdf endet; für eine Messung ohne Diagnose wird diese zuerst gestartet
path-a-name-that-ends-in-svg-or-png = Ein Name, der auf .svg oder .png endet
path-what-was-changed-is-written = Was geändert wurde, wird daneben als NAME.meta.json geschrieben

## preferences

preferences-preferences = Einstellungen
preferences-inch = Zoll
preferences-angles = Winkel in
preferences-readable = lesbar
preferences-decimals-of-lengths = Dezimalen (Längen)
preferences-as-the-system = wie System
preferences-light = hell
preferences-dark = dunkel
preferences-colours = Farben
preferences-size-of-text = Textgröße
preferences-files-are-read-and-written = Dateien werden in ihren eigenen Einheiten gelesen und geschrieben, was immer hier gezeigt wird
preferences-reset-all = Zurücksetzen
preferences-language = Sprache

## recovery

recovery-not-saved-when-the-program = Beim Programmende nicht gespeichert
recovery-the-last-time-the-program = Das Programm endete zuletzt ohne Vorwarnung. Nichts geht verloren, solange es hier nicht verworfen wird: Was jetzt nicht wiederhergestellt wird, wird erneut angeboten
recovery-a-file-that-is-damaged = Eine beschädigte Datei
recovery-kept = gesichert
recovery-its-file = Datei
recovery-discard = Verwerfen
recovery-restore = Wiederherstellen
recovery-put-it-aside = Beiseitelegen
recovery-discard-all = Alle verwerfen
recovery-not-now = Nicht jetzt
recovery-less-than-a-minute-ago = vor weniger als einer Minute
recovery-its-first-line-is-not = die erste Zeile ist unvollständig
recovery-its-first-line-cannot-be = die erste Zeile ist nicht lesbar
recovery-expected-the-format = erwartet wurde das Format { $format }
recovery-of-bytes-are-there = { $document } von { $bytes } Bytes sind da
recovery-its-contents-do-not-agree = der Inhalt passt nicht zu seinem Hash
recovery-minutes-ago =
    { $count ->
        [one] vor { $count } Minute
       *[other] vor { $count } Minuten
    }
recovery-hours-ago =
    { $count ->
        [one] vor { $count } Stunde
       *[other] vor { $count } Stunden
    }
recovery-days-ago =
    { $count ->
        [one] vor { $count } Tag
       *[other] vor { $count } Tagen
    }

## unsaved

unsaved-leave-without-saving = Ohne Speichern beenden?
unsaved-leave-without-saving-2 = Ohne Speichern beenden
unsaved-open-without-saving = Ohne Speichern öffnen?
unsaved-open-without-saving-2 = Ohne Speichern öffnen
unsaved-simulate-without-saving = Ohne Speichern simulieren?
unsaved-simulate-without-saving-2 = Ohne Speichern simulieren
unsaved-changes-of-are-not = Änderungen an { $name } sind nicht in der Datei { $file }
unsaved-the-session-is-in-no = Die Messung { $name } ist in keiner Datei
unsaved-what-was-identified = Was an { $name } identifiziert wurde, ist in keiner Datei
unsaved-go = Weiter
unsaved-replace-what-another-program-wrote = Ersetzen, was ein anderes Programm geschrieben hat?
unsaved-changed-since-it-was-read = { $path } wurde seit dem Lesen geändert. Speichern würde das dort Geschriebene ersetzen
unsaved-save-under-another-name = Unter anderem Namen speichern …
unsaved-replace = Ersetzen

## glossary

glossary-the-same-stands-beside = Dasselbe steht neben den Zahlen, wo der Zeiger auf einem Namen ruht

## settings

settings-they-were-damaged-and-are = sie waren beschädigt und liegen jetzt als { $aside } vor
settings-is-damaged = { $path } ist beschädigt

## file

file-it-was-cancelled = es wurde abgebrochen
file-exists-already-allow-replacing = { $path } gibt es schon; erlauben Sie das Ersetzen oder wählen Sie einen anderen Namen
file-is-a-folder-or = { $path } ist ein Ordner oder ein Gerät und kann nicht ersetzt werden; wählen Sie einen anderen Namen
file-the-disk-is-full-make = der Datenträger ist voll: Schaffen Sie Platz oder speichern Sie auf einem anderen
file-the-disk-can-only-be = der Datenträger ist schreibgeschützt: Speichern Sie auf einem anderen
file-nothing-may-be-written-there = dort darf nicht geschrieben werden: Speichern Sie in einem anderen Ordner
file-the-folder-is-not-there = den Ordner gibt es nicht: Wählen Sie einen anderen oder legen Sie ihn an
file-the-name-is-too-long = der Name ist zu lang oder enthält ein unzulässiges Zeichen: Wählen Sie einen anderen
file-there-is-no-such-example = Dieses Beispiel gibt es nicht
file-the-examples-are = Die Beispiele stehen im Menü Datei
file-opened = geöffnet
file-expected-the-name = erwartet wurde ein Dateiname in UTF-8
file-exists-already-allow-replacing-it-or = { $there } gibt es schon; erlauben Sie das Ersetzen oder wählen Sie einen anderen Namen
file-was-not-written = { $path } wurde nicht geschrieben
file-what-was-there-before = Der vorige Inhalt ist noch da
file-read = gelesen
file-checking-samples = { $samples } Messpunkte werden geprüft
file-could-not-be-nothing-was = { $name } konnte nicht { $done } werden; nichts wurde geändert
file-the-system-has-no-program = das System hat kein Programm dafür
file-expected-a-file-name = erwartet wurde ein Dateiname, der auf .svg oder .png endet
file-the-diagnosis-was-run = Die Diagnose wurde dafür ausgeführt
file-some-letters-stand = Einige Zeichen stehen darin als Codes: { $says }
file-names-the-table-with-its = Nennt die Tabelle { $table } mit ihrem Hash
file-a-table-is-not-named = Eine Tabelle ist darin nicht genannt: { $because }
file-could-not-be-saved = { $path } konnte nicht gespeichert werden

## dialog

dialog-open-session-model-or-measurements = Messung, Modell oder Messdaten öffnen
dialog-sessions-and-models-json = Messungen und Modelle (*.json)
dialog-all-files = Alle Dateien
dialog-targets-or-program-to-correct = Zu korrigierende Zielpunkte oder Programm
dialog-import-measurements = Messdaten importieren
dialog-where-the-robot-was-sent = Sollpositionen des Roboters
dialog-points-known-in-the-base = Im Basissystem bekannte Punkte
dialog-reflectors-in-the-tool-frame = Reflektoren im Werkzeugsystem
dialog-robots-and-sessions-json-urdf = Roboter und Messungen (*.json, *.urdf, *.xml)
dialog-tables-csv-txt-tsv-dat = Tabellen (*.csv, *.txt, *.tsv, *.dat, *.asc)
dialog-measurements-csv-txt-tsv-dat = Messdaten (*.csv, *.txt, *.tsv, *.dat, *.asc)
dialog-session-json = Messung (*.json)
dialog-html-or-pdf-html-pdf = HTML oder PDF (*.html, *.pdf)
dialog-pdf = PDF (*.pdf)
dialog-svg-or-png-picture = SVG- oder PNG-Bild (*.svg, *.png)
dialog-model-json = Modell (*.json)
dialog-csv-table-csv = CSV-Tabelle (*.csv)
dialog-targets = Zielpunkte
dialog-folder-with-the-sessions = Ordner mit den Messungen einer Maschine
dialog-logo-of-the-report = Logo des Berichts
dialog-png-pictures = PNG-Bilder

## running

running-cancelling = wird abgebrochen

## gestures

gestures-wheel-or-pinch = Mausrad oder Zweifingergeste
gestures-zoom-at-the-pointer = am Zeiger zoomen
gestures-shift-and-wheel = Umschalt und Mausrad
gestures-zoom-along-a-charts-axis = entlang der Diagrammachse zoomen
gestures-drag = ziehen
gestures-move = verschieben
gestures-drag-with-the-right-button = mit der rechten Taste ziehen
gestures-show-a-part = einen Ausschnitt zeigen
gestures-drag-in-the-3-d = in der 3-D-Ansicht ziehen
gestures-orbit = drehen
gestures-shift-or-middle-button = Umschalt oder mittlere Taste und in der 3-D-Ansicht ziehen
gestures-double-click-or-home = Doppelklick oder Pos1
gestures-fit-the-view = Ansicht einpassen

## legend

legend-show = { $name } zeigen
legend-leave-it-out-so = Weglassen, damit der Rest zu sehen ist
legend-show-it-as-well = Auch zeigen
legend-as-measured = wie gemessen
legend-legend = Legende
legend-nominal-path = Sollbahn
legend-over-the-ranges = Stellungen über die Gelenkbereiche
legend-nominal-circle = Sollkreis
legend-mean-before = Mittel vorher
legend-mean-after = Mittel nachher
legend-from-the-smallest = bei jedem Winkel vom kleinsten bis zum größten Wert

## plots

plots-save-picture = Bild des { $plot } speichern …
plot-workspace = Arbeitsraums
plot-3-D-view = 3-D-Bildes
plot-polar = Polarbildes
plot-deviation = Diagramms Abweichung
plot-deviation-over-time = Diagramms Abweichung über der Zeit
plot-deviation-over-load = Diagramms Abweichung über der Last
plot-deviation-over-temperature = Diagramms Abweichung über der Temperatur
plot-deviation-by-joint = Diagramms Abweichung je Gelenk
plot-order-spectrum = Ordnungsspektrums
plot-histogram = Histogramms
plot-normal-quantiles = Quantildiagramms
plot-gap-by-step = Fehlerdiagramms
plot-effect-s-curve = Effektverlaufs
plot-correction-table = Diagramms der Korrekturtabelle

## camera

camera-isometric = isometrisch
camera-top = oben
camera-front = vorn
camera-side = Seite
camera-view = Ansicht { $view }
camera-seen-from-azimuth-elevation = gesehen aus Azimut { $azimuth }°, Elevation { $elevation }°

## looking

looking-before-and-after = vorher und nachher
looking-uncertainty = Unsicherheit (1σ)

## message

message-saved = { $name } gespeichert
message-there-is-nothing-to-search = Es gibt noch nichts zu untersuchen
message-open-a-session-that-was = Öffnen Sie eine Messung dieses Roboters
message-the-model-from-a-file = des Modells aus einer Datei
message-the-identification-by-region = der Identifikation nach Regionen
message-identified-with-the-full-model = Mit dem vollen Modell identifiziert anstelle { $before }
message-the-diagnosis-starts = Die Diagnose geht vom vollen Modell aus; Rückgängig stellt das andere wieder her
message-identifying = Identifizieren, { $samples }
message-preparing-the-table = Tabelle wird vorbereitet
message-drawing = Zeichnen
message-waiting-for-a-file = warten auf die Wahl einer Datei
message-waiting-for-a-file-name = warten auf einen Dateinamen
message-could-not-be-opened = { $path } konnte nicht geöffnet werden
message-something-went-wrong-inside = Im Programm ist etwas schiefgegangen
message-nothing-was-changed-save-your = Nichts wurde geändert; sichern Sie Ihre Arbeit und melden Sie bitte, was Sie zuletzt getan haben
message-no-file-was-chosen = Es wurde keine Datei gewählt
message-if-no-dialog-appeared-drop = Wenn kein Dialog erschien, ziehen Sie die Datei auf das Fenster oder geben Sie ihren Pfad im Schritt Messung ein
message-there-is-no-model = Es gibt kein Modell, um Zielpunkte zu korrigieren
message-identify-the-robot-first-or = Identifizieren Sie zuerst den Roboter oder öffnen Sie ein Modell
message-correcting-the-targets = Zielpunkte von { $name } werden korrigiert
message-there-are-no-corrected-targets = Es gibt noch keine korrigierten Zielpunkte
message-choose-a-table-of-targets = Wählen Sie zuerst eine Zielpunkttabelle oder ein Roboterprogramm
message-writing = { $path } wird geschrieben
message-this-change-cannot-be-made = Diese Änderung ist nicht möglich
message-regions-divide-what-was-measured = Regionen teilen, was an einem einzelnen Drehgelenk gemessen wurde
message-looking-where-regions-are-needed = suche, wo Regionen nötig sind
message-there-is-no-measuring-list = Es gibt noch keine Messliste
message-run-the-diagnosis-first = Starten Sie zuerst die Diagnose
message-there-is-nothing-to-export = Es gibt noch nichts zu exportieren
message-there-is-no-file = Es gibt keine Datei zu verfolgen
message-the-samples-of-this-session = Die Messpunkte dieser Messung haben keine eigene Datei
message-the-file-was-rewritten = Die Datei wurde neu geschrieben und wird neu gelesen
message-what-was-read-before = Das zuvor Gelesene ist noch da; berichtigen Sie die Datei und verfolgen Sie sie dann wieder
message-the-file-cannot-be-followed = Die Datei kann nicht weiter verfolgt werden
message-looking-at-the-file = Datei wird gelesen
message-the-window-closes-after = Das Fenster schließt nach: { $what }
message-reading = { $path } wird gelesen
message-reading-an-example = Beispiel wird gelesen
message-simulating = Simulation läuft
message-saving = { $path } wird gespeichert
message-there-is-no-session = Es gibt keine Messung zu speichern
message-a-model-by-itself = Ein Modell allein wird im Schritt Export gespeichert
message-there-is-nothing-to-report = Es gibt noch nichts zu berichten
message-open-a-session-or-identify = Öffnen Sie eine Messung oder identifizieren Sie zuerst den Roboter
message-the-figures-could-not-be = Die Kennwerte konnten nicht berechnet werden
message-restored-it-is-not-saved = Wiederhergestellt; noch nicht gespeichert
message-what-was-left-behind = Das Gesicherte ist beschädigt und kann nicht wiederhergestellt werden
message-it-is-kept-as = Es liegt als { $aside } vor
message-preferences-could-not-be-read = Die Einstellungen konnten nicht gelesen werden: { $says }
message-what-is-not-saved-cannot = Nicht Gespeichertes kann nicht gegen einen Absturz gesichert werden: { $home }: { $error }
message-not-everything-could-be-set = Nicht alles konnte eingerichtet werden
message-not-everything-could-be-kept = Nicht alles konnte gesichert werden
message-the-session-is-as = Die Messung ist unverändert; speichern Sie sie unter eigenem Namen
message-waiting-for-a-folder = warten auf die Wahl eines Ordners
message-comparing-the-sessions = Messungen in { $folder } werden verglichen
message-there-are-no-sessions = Es gibt keine Messungen zu vergleichen
message-nothing-can-be-recorded = Es kann nichts aufgezeichnet werden
message-recorded = { $path } aufgezeichnet: { $says }
message-the-recording-ended = Die Aufzeichnung ist beendet
message-what-was-recorded-before = Was bis dahin aufgezeichnet wurde, steht in der Datei

## view

view-regions = Regionen
view-diagnose = Diagnose

## chart

chart-component = Komponente
chart-joint-of-the-chart = Gelenk des Diagramms
chart-fit-chart-to-view = Diagramm einpassen
chart-computing = Wird berechnet …

## compensate

compensate-compensate = Kompensieren …
compensate-a-table-of-targets-csv = Eine Tabelle von Zielpunkten (CSV), RAPID, KRL, URScript oder FANUC LS: Die Zielpunkte werden an Ort und Stelle korrigiert, und was sich ändert, wird vor dem Speichern gezeigt

## copies

copies-copied = Kopiert
copies-copy = Kopieren
copies-table = { $says }: Tabelle { $of }
copies-copy-numbers = Zahlen kopieren: { $of }

## coverage

coverage-rms-error-of-the-nominal = RMS-Fehler des Sollroboters
coverage-largest-deviation = größte Abweichung
coverage-of = { $inside } von { $all }
coverage-instrument = { $floor }, Messgerät
coverage-not-identified-yet-the-identified = Noch nicht identifiziert. Hier stehen dann die identifizierten Parameter mit dem Intervall jeder Zahl
coverage-what-the-samples-cover = Abdeckung der Messpunkte
coverage-measured-range = gemessener Bereich
coverage-widest-hole = größte Lücke
coverage-not-recorded = nicht aufgezeichnet
coverage-took = Dauer
coverage-throughout = durchgehend { $decimals } { $unit }
coverage-samples-over-the-range = Messpunkte über dem Bereich von Gelenk 1
coverage-samples-over-the-range-of-joint = Messpunkte über dem Bereich von Gelenk 1: Wo er leer ist, ist nichts bekannt
coverage-testable-effects = Prüfbare Effekte
coverage-can-be-tested = { $yes } sind prüfbar
coverage-cannot-and-why = { $no } nicht, und warum
coverage-no-diagnosis-yet = Noch keine Diagnose
coverage-effects-that-are-found-will = Gefundene Effekte stehen dann hier mit Größe, Sicherheit und dem, was an der Maschine zu prüfen ist. Wo die Messpunkte nicht entscheiden können, stehen beide mit den Posen, die entscheiden würden
coverage-it-takes-a-moment = Das dauert einen Moment, bei einer Million Messpunkten einige Sekunden. Das Fenster bleibt währenddessen frei, und die Suche lässt sich anhalten
coverage-nothing-to-export-yet = Noch nichts zu exportieren
coverage-the-table-comes = Die Tabelle entsteht aus dem identifizierten Roboter. Sie steht dann hier als Text, mit der Vorzeichenregel in Worten, dem RMS-Fehler, den sie lässt, und dem, was Gelenkbefehle nicht korrigieren können
coverage-below-none-above = { $up } von unten, keiner von oben
coverage-none-below-above = keiner von unten, { $down } von oben
coverage-below-above = { $up } von unten, { $down } von oben
coverage-standstill = Stillstand
coverage-throughout-2 = durchgehend { $speed }
coverage-up = bis { $speed }
coverage-came-from = Anfahrrichtung
coverage-came-from-joint = Anfahrrichtung, Gelenk { $joint }
coverage-speed = Geschwindigkeit
coverage-speed-joint = Geschwindigkeit, Gelenk { $joint }

## disk

disk-was-changed-by-another-program = { $name } wurde von einem anderen Programm geändert
disk-reload-reads-it-again-undo = Neu laden liest sie erneut; Rückgängig stellt den jetzigen Stand wieder her. Wenn Sie diese Fassung behalten, werden Sie vor dem Überschreiben gefragt
disk-what-was-read-is-here = Das Gelesene ist noch da: Speichern schreibt es neu, oder legen Sie die Datei zurück
disk-keep-this = Diese behalten
disk-reload = Neu laden
disk-save-it-again = Wieder speichern
disk-save-it-again-2 = Wieder speichern …

## dropped

dropped-drop-the-file-to-open = Datei zum Öffnen loslassen

## export

export-there-is-nothing-to-export = Es gibt noch nichts zu exportieren: Die Tabelle entsteht aus dem identifizierten Roboter
export-found-but-not = Gefunden, aber nicht im Modell und daher nicht korrigiert: { $names }
export-add-it-to-the-model = Zum Modell hinzufügen
export-add-all-to-the-model = Alle { $n } zum Modell hinzufügen
export-report = Bericht
export-html-or-pdf-what-was = HTML oder PDF: was gemessen wurde, was die Suche fand, was offen bleibt
export-html-or-pdf-the-session = HTML oder PDF: Die Messung wird dafür zuerst untersucht, was etwas dauert
export-report-of-the-model = Bericht zum Modell …
export-format = Format
export-the-table-is-being-prepared = Die Tabelle wird vorbereitet
export-entries = Einträge
export-also = Außerdem
export-copy-text = Text kopieren
export-custom-step = Eigene Schrittweite
export-rms-error-to-this-robot = RMS-Fehler zu diesem Roboter
export-rms-error-left = RMS-Fehler mit der Tabelle
export-not-correctable-by-joint-commands = Durch Gelenkbefehle nicht korrigierbar
export-over-the-samples-noise = Über die Messpunkte: Rauschen sowie Lasten und Wärme, die keine Tabelle kennt, sind enthalten; was das Modell für sich verspricht, steht unten
export-model-and-measurement = Modell und Messung
export-the-model-says-that-more = Das Modell sagt, dass mehr bleibt als gemessen wurde: Es ist nicht dieser Roboter
export-what-the-numbers-mean = Bedeutung der Zahlen
export-and-more-lines = und { $more } weitere Zeilen
export-go-to-identify = Zum Identifizieren
export-save-as = { $what } als .{ $title } speichern …
export-without-it = ohne Korrektur

## found

found-p-chance-that-noise-alone = p { $sign } { $p } (Wahrscheinlichkeit, dass bloßes Rauschen so aussieht)
found-more-than-1000 = Mehr als 1000
found-times-likelier-than-the-next = { $odds }-mal wahrscheinlicher als der nächste Kandidat, { $next }
found-cross-validated-rms-error = kreuzvalidierter RMS-Fehler
found-what-to-check = Was zu prüfen ist
found-add-to-model = Zum Modell hinzufügen
found-in-the-model = im Modell
found-mend-all = Alle { $mends } berichtigen

## limits

limits-detection-limits-95 = Nachweisgrenzen: { $number } (95 %)
limits-detection-limits = Nachweisgrenzen
limits-not-testable = Nicht prüfbar: { $not_testable }

## diagnosis

diagnosis-diagnosis = Diagnose
diagnosis-nothing-found-so-far = Bisher nichts gefunden
diagnosis-found-so-far-a-likelier = Bisher gefunden; ein wahrscheinlicherer Name kann an die Stelle treten
diagnosis-diagnosis-is-running = Die Diagnose läuft
diagnosis-it-had-found-nothing-until = Bis dahin wurde nichts gefunden
diagnosis-found-until-then-not-yet = Bis dahin gefunden, noch nicht gegen andere Namen geprüft: Starten Sie die Diagnose dafür erneut
diagnosis-diagnosis-stopped = Diagnose angehalten
diagnosis-found-effects = der gefundenen Effekte
diagnosis-nothing-is-missing = Es fehlt nichts
diagnosis-explained-the-remaining-error = Erklärt: Der verbleibende Fehler liegt an der Rauschgrenze
diagnosis-partly-explained-an-error = Teilweise erklärt: Ein Fehler bleibt ohne Namen
diagnosis-not-explained-by-any-effect = Durch keinen Effekt erklärt
diagnosis-from-repeats = aus Wiederholungen
diagnosis-of-the-instrument = des Messgeräts
diagnosis-these-samples-can-show-no = diese Messpunkte können keinen Effekt zeigen: Dass nichts gefunden wurde, sagt nichts
diagnosis-the-samples-also-allow-another = die Messpunkte erlauben auch eine andere Erklärung, siehe unten
diagnosis-held-out = Zurückgehalten: { $how }
diagnosis-noise-stated = Rauschen σ, angegeben
diagnosis-noise-as-found = Rauschen σ, gefunden
diagnosis-slow-noise = Langsames Rauschen: { $slow }
diagnosis-the-samples-cannot-rule-out = Nicht auszuschließen
diagnosis-instead = { $instead } statt { $explanation }
diagnosis-1-against = { $odds } : 1 dagegen. { $separate_by }
diagnosis-excluded-by-hand = Von Hand ausgeschlossen
diagnosis-excluded-outliers = Ausgeschlossene Ausreißer: { $excluded } von { $all }
diagnosis-and-more = und { $more } weitere

## next

next-measure-these-poses-next = Messen Sie als Nächstes diese Posen
next-second-time-the-same-pose = Zweites Mal: dieselbe Pose erneut, nach einer anderen, da einmal über dem Rauschen nicht genügt
next-and-more-in-the-measuring = und { $more } weitere in der Messliste
next-poses = der Posen
next-save-measuring-list = Messliste speichern …

## diagnose

diagnose-open-a-session-that-was = Öffnen Sie zuerst eine Messung dieses Roboters
diagnose-looks-for-the-physical-effect = Sucht den physikalischen Effekt, der dem Modell fehlt, und belegt jeden Namen an Messpunkten, die die Suche nicht gesehen hat
diagnose-nominal-robot = Sollroboter
diagnose-with-found-effects = mit gefundenen Effekten
diagnose-run-diagnosis-again = Diagnose erneut starten
diagnose-rms-error-so-far = RMS-Fehler bisher
diagnose-the-diagnosis-identifies-by-itself = Die Diagnose identifiziert selbst: Identifizieren muss nicht vorangehen
diagnose-little-error-is-left-above = Über dem Rauschen des Messgeräts bleibt wenig Fehler. Die Diagnose sagt mit den Nachweisgrenzen, wo nichts fehlt
diagnose-more-error-is-left-than = Es bleibt mehr Fehler, als Rauschen erklärt, oder kein Rauschen ist angegeben: Die Diagnose zeigt, was zutrifft
diagnose-the-diagnosis-starts = Die Diagnose geht vom vollen Modell aus, das an die Stelle des jetzt Identifizierten tritt. Rückgängig stellt es wieder her
diagnose-what-it-can-find = Was sie finden kann
diagnose-why-the-others-are-not = Warum die anderen nicht prüfbar sind, steht rechts, mit dem, was dafür zu messen ist
diagnose-diagnosing = Diagnose läuft
diagnose-found-so-far = bisher gefunden
diagnose-so-far-a-likelier-name = bisher; ein wahrscheinlicherer Name kann an die Stelle treten
diagnose-in-the-model = Im Modell
diagnose-use = { $effect } verwenden
diagnose-one-effect-in-the-model = ein Effekt im Modell
diagnose-effects-in-the-model = { $on } Effekte im Modell
diagnose-nothing-is-missing = es fehlt nichts
diagnose-something-unexplained = etwas Unerklärtes
diagnose-one-effect-found = ein Effekt gefunden
diagnose-effects-found = { $n } Effekte gefunden
diagnose-stop-the-search = Suche anhalten

## grips

grips-steps = Schritte
grips-results = Ergebnisse

## identify

identify-model-from-a-file = Modell aus Datei
identify-by-region = nach Regionen
identify-parameters = volles Modell, { $count } Parameter
identify-with-the-full-model = volles Modell
identify-the-model-in-takes = Das Modell in { $given } tritt an die Stelle einer Identifikation
identify-to-identify-the-robot-anew = Um den Roboter neu zu identifizieren, öffnen Sie eine Messung an ihm
identify-identify-from-this-session = Aus dieser Messung identifizieren
identify-method = Verfahren
identify-full-model = Volles Modell
identify-by-region-2 = Nach Regionen
identify-one-model-for-the-whole = Ein Modell für den ganzen Bereich, im Messsystem angepasst, mit einem Intervall für jede Zahl
identify-the-source-papers-method = Das Verfahren der Veröffentlichung: eine konstante Korrektur von Winkel und Radius je Region. Es lässt die Drehung zwischen Leuchte und Basis weg, sodass ein konstanter Fehler in jeder Region anders aussieht; verwenden Sie es zum Vergleich mit früheren Berichten
identify-change-the-regions = Regionen ändern
identify-effects-to-fit = Anzupassende Effekte
identify-that-this-session-cannot-show = { $not_testable }, die diese Messung nicht zeigen kann
identify-identified-the-result-follows-every = Identifiziert; das Ergebnis folgt jeder Änderung
identify-continue-to-diagnose = Weiter zur Diagnose

## menu

menu-examples = Beispiele
menu-not-there-any-more = nicht mehr da
menu-standard-3-d-views = Standardansichten 3-D
menu-larger = Größer
menu-smaller = Kleiner
menu-usual-size = Normale Größe
menu-file = Datei
menu-edit = Bearbeiten
menu-view = Ansicht
menu-help = Hilfe
menu-nothing-to-redo = Nichts zu wiederholen
menu-redo = Wiederholen: { $what }
menu-nothing-to-undo = Nichts rückgängig zu machen
menu-undo = Rückgängig: { $what }
menu-example = Beispiel
menu-simulated = simuliert
menu-restored = wiederhergestellt
menu-from = aus { $path }
menu-model = Modell { $origin }
menu-model-2 = { $origin } · Modell { $given }
menu-not-saved = { $origin } · nicht gespeichert

## model

model-model-from-a-file = Modell aus einer Datei
model-file = Datei
model-identified = identifiziert aus
model-measured = gemessen, { $joint }
model-nothing-was-measured-yet-open = Es wurde noch nichts gemessen. Öffnen Sie eine Messung dieses Roboters; was das Modell dort bewirkt, steht dann hier
model-how-it-came-about = Wie es entstand
model-held-out = { $gap }, zurückgehalten { $held_out }
model-held-against-this-session = An dieser Messung geprüft
model-measured-and-model = Messung und Modell
model-with-corrected-commands = mit korrigierten Sollwerten
model-largest-then = dann größte
model-the-largest-deviations-among-them = , darunter die größten Abweichungen
model-of-samples = { $drawn } von { $samples } Messpunkten{ $largest }

## names

names-and = {" "}und{" "}
names-not-identifiable = Nicht identifizierbar
names-show-its-curve = Kurve zeigen

## pictures

pictures-there-is-no-such-chart = dieses Diagramm gibt es nicht
pictures-the-deviation-around-the-angle = die Abweichung über den Winkel
pictures-measured-points-deviations-magnified-times = gemessene Punkte, Abweichungen { $magnification }-fach vergrößert

## regions

regions-from-to-and-where = { $regions } von { $low } bis { $high } und die Lage der Messpunkte
regions-region = Region { $name }, { $from } … { $to }: { $samples }
regions-in-no-region = in keiner Region
regions-optional = optional
regions-optional-2 = optional, { $regions }
regions-regions-divide-what-was-measured = Regionen teilen, was gemessen wurde: Öffnen Sie eine Messung dieses Roboters
regions-uniform = Gleichmäßig
regions-manual = Von Hand
regions-adaptive = Adaptiv
regions-drag-a-boundary = Ziehen Sie eine Grenze im Diagramm oder geben Sie sie ein; die Identifikation folgt sofort
regions-region-2 = {" "}Region
regions-regions = {" "}Regionen
regions-number-of-regions = Anzahl der Regionen
regions-divide = Teilen
regions-reset-to-session = Wie in der Messung
regions-take-the-regions = die Regionen übernehmen, die die Messung mitbringt
regions-there-are-no-regions-nothing = Es gibt keine Regionen: Nichts wird regionsweise korrigiert. Teilen Sie den Bereich gleichmäßig oder wo die Daten es verlangen
regions-there-are-no-regions-because = Es gibt keine Regionen, weil alle Messpunkte bei einem Winkel liegen: Es gibt keinen Bereich zu teilen. Geben Sie dem Gelenk im Schritt Messung Grenzen oder messen Sie bei anderen Winkeln. Das volle Modell in Identifizieren braucht keine Regionen
regions-and-more = { $gap } und { $n } weitere
regions-in-no-region-and-no = { $more }: in keiner Region, dort liegt kein Messpunkt
regions-in-no-region-1-sample = { $more }: in keiner Region; 1 Messpunkt dort bleibt ohne Korrektur
regions-in-no-region-samples-there = { $more }: in keiner Region; { $n } Messpunkte dort bleiben ohne Korrektur
regions-sample = Messpunkt liegt
regions-samples-are = Messpunkte liegen
regions-in-no-region-and-get = { $outside } { $samples } in keiner Region, ohne Korrektur
regions-optional-fills-the-next-step = Optional: füllt den nächsten Schritt, Identifizieren, Region für Region
regions-identify-by-region = Nach Regionen identifizieren
regions-split-in-half = Halbieren
regions-it-is-too-narrow = sie ist zu schmal
regions-merge-with-previous = Mit voriger vereinigen
regions-merge-with-next = Mit nächster vereinigen
regions-no-region-touches = keine Region grenzt an sie
regions-delete = Löschen
regions-the-last-region-stays = die letzte Region bleibt
regions-rename = Umbenennen
regions-change-region = Region { $name } ändern
regions-with-the-focus-here-s = mit dem Fokus hier: S teilt, M vereinigt, Entf löscht, R benennt um
regions-and-more-to-be-dragged = und { $more } weitere, im Diagramm zu ziehen
regions-name = Name
regions-from = von, { $unit }
regions-to = bis, { $unit }
regions-no-sample-so-no-correction = kein Messpunkt, also keine Korrektur: Messen Sie hier oder vereinigen Sie sie mit der nächsten
regions-none-of-which-can-be = { $measured }, keiner davon anpassbar, also keine Korrektur
regions-one-sample-to-fit = ein Messpunkt zum Anpassen: eine Korrektur, aber nichts über ihre Unsicherheit
regions-name-of-region = Name der Region { $name }
regions-region-3 = { $end }, Region { $region }
regions-from-2 = Von
regions-to-2 = Bis
regions-until-then-it-stays = { $which }{ $says }. Bis dahin bleibt es bei { $stays }
regions-show-the-sample-of-region = Messpunkt der Region { $region } zeigen
regions-show-the-of-region = { $samples } der Region { $region } zeigen
regions-region-from = Region { $region }, von:{" "}
regions-region-to = Region { $region }, bis:{" "}

## results

results-summary = Übersicht
results-samples = Messpunkte
results-this-could-not-be-identified = Das konnte nicht identifiziert werden
results-rms-error-by-region = RMS-Fehler, nach Regionen
results-rms-error-model = RMS-Fehler, Modell aus Datei
results-rms-error-full-model = RMS-Fehler, volles Modell
results-largest = größte
results-of = { $before } → { $after } von { $all }
results-identified-parameters = Identifizierte Parameter
results-half-the-95-interval = ± halbes 95-%-Intervall
results-parameters = der Parameter
results-correction-of-each-region = Korrektur je Region
results-was = vorher { $rms_before }
results-what-to-add = Zu addieren
results-what-to-add-half = Zu addieren, ± halbes 95-%-Intervall
results-measurement-noise = Messrauschen: { $noise }
results-excluded-outliers-of-samples = ausgeschlossene Ausreißer: { $excluded } von { $all } Messpunkten
results-sample-is-an-outlier = Messpunkt { $sample } ist ein Ausreißer: { $deviation } vom Modell
results-sample-is-excluded = Messpunkt { $sample } ist ausgeschlossen: { $because }
results-and-more = und { $more } weitere
results-notes = Hinweise
results-region = Region
results-no-decision = Keine Entscheidung: { $because }

## samples

samples-sample = Punkt
samples-angle = Winkel, { $angle }
samples-before = vorher, { $length }
samples-after = nachher, { $length }
samples-largest-first = , größte zuerst
samples-smallest-first = , kleinste zuerst
samples-column = Spalte { $name }{ $order }
samples-excluded-by-hand-in-no = von Hand ausgeschlossen, in keiner Kennzahl
samples-row = Zeile { $sample }, { $what }
samples-within-the-tolerance = in der Toleranz
samples-outside-the-tolerance = außerhalb der Toleranz

## session

session-a-model-nothing-measured = ein Modell, nichts gemessen
session-measured = Gemessen
session-another-session-or-model = Andere Messung oder anderes Modell
session-none-this-is-a-model = keine: dies ist ein Modell
session-reflectors = Reflektoren
session-not-given = nicht angegeben
session-noise-one = Rauschen, ein σ
session-coordinates = Koordinaten
session-x-and-y-z-was = x und y; z wurde nicht gemessen
session-compensated = kompensiert
session-yes-this-shows-what = ja: dies zeigt, was bleibt
session-new-lines-are-read-as = Neue Zeilen werden gelesen, sobald sie geschrieben sind, und das Ergebnis folgt
session-came-since = { $samples } seither hinzugekommen
session-import-log = Importprotokoll: { $count }
session-note = Hinweis
session-warning = Warnung
session-error = Fehler
session-type-a-path-or-drop = Pfad, oder Datei ablegen
session-path-of-a-session-or = Pfad einer Messung oder eines Modells
session-this-is-an-example = Dies ist ein Beispiel, das mit dem Programm kommt
session-continue-to-regions = Weiter zu den Regionen

## standards

standards-accuracy-and-repeatability = Genauigkeit und Wiederholpräzision
standards-the-figures-are-being-worked = Die Kennwerte werden berechnet
standards-figures = der Kennwerte
standards-missing = fehlt: { $line }
standards-from-below-from-above = ↑ von unten, ↓ von oben
standards-measured = gemessen, { $group }

## status

status-model-of-open-a-session = Modell von { $robot } · öffnen Sie eine Messung dieses Roboters, um die Wirkung des Modells zu sehen
status-rms-error = RMS-Fehler { $gaps } { $unit }
status-rms-error-2 = RMS-Fehler { $rms } { $unit }
status-no-sample-can-be-used = kein Messpunkt ist verwendbar
status-floor = {" "}· Rauschgrenze { $floor } { $unit } ({ $from })
status-repeats = Wiederholungen
status-identify-again = Erneut identifizieren
status-the-identification-was-cancelled = die Identifikation wurde abgebrochen
status-stop-following = Nicht mehr verfolgen
status-following-the-file-new = Datei wird verfolgt · { $came } neu
status-understood = Verstanden

## toast

toast-show-in-folder = Im Ordner zeigen

## details

details-report-details = Angaben zum Bericht
details-stated-at-the-head = Steht am Anfang des Berichts und wird für diese Maschine gemerkt; was leer ist, wird eine Zeile zum Ausfüllen von Hand
details-such-as-a-date = zum Beispiel 22. Nov. 2026
details-field-report_number = Berichtsnummer
details-field-date = Datum
details-field-customer = Kunde
details-field-machine = Maschine
details-field-machine_serial = Seriennummer der Maschine
details-field-instrument = Messgerät
details-field-instrument_serial = Seriennummer des Messgeräts
details-field-instrument_calibrated = Messgerät kalibriert am
details-field-operator = Bediener
details-logo = Logo
details-a-png-file = eine PNG-Datei
details-history = Verlauf der Maschine
details-compare-the-sessions = Die Messungen dieses Roboters im Ordner der Messung vergleichen
details-save-the-session-first = Die Messung ist noch in keinem Ordner: zuerst speichern
details-logo-cannot-be-used = Logo { $found }; erwartet: { $expected }
details-pass-or-fail = Bestanden oder nicht
details-last-time-it-was = Letztes Mal waren es { $last } mm
details-use-it = Übernehmen
details-decision-rule = Entscheidungsregel
details-not-decided = keine Entscheidung
details-simple-acceptance = einfache Akzeptanz
details-the-reader-decides = Der Bericht nennt die Fehler und überlässt die Entscheidung dem Leser
details-pass-with-its-uncertainty = Bestanden, wo die größte Abweichung zusammen mit ihrer Unsicherheit in der Toleranz liegt; nicht bestanden, wo die Abweichung ohne ihre Unsicherheit darüber liegt; dazwischen ist keines von beiden nachgewiesen
details-pass-without-its-uncertainty = Bestanden, wo die größte Abweichung in der Toleranz liegt; die Unsicherheit wird angegeben und zählt nicht (JCGM 106, 8.2)

## history

history-of = Verlauf von { $robot }
history-of-the-folder-by-time = Messungen und Modelle des Ordners { $folder }, nach der Zeit des ersten Messpunkts
history-of-the-folder-by-name = Messungen und Modelle des Ordners { $folder }, nach Dateinamen, Zahlen darin nach ihrem Wert
history-robot = Roboter
history-all-sessions = Alle Messungen
history-before-and-after = Vorher und nachher
history-before = Vorher
history-after = Nachher
history-is-excluded = { $file } ist ausgeschlossen: { $because }
history-other-folder = Anderer Ordner …
history-errors = Fehler
history-parameters = Parameter
history-no-parameter-was-identified = Es wurde kein Parameter identifiziert
history-half-the-95-interval = ± halbes 95-%-Intervall; { $mark } um mehr als sein Intervall geändert
history-the-last-sessions = ; die letzten { $shown } von { $all } Messungen
history-over-the-sessions = { $parameter } über den Messungen
history-no-parameter-in-common = Sie haben keinen Parameter gemeinsam
history-parameters-changed = { $changed } von { $all } Parametern haben sich um mehr als das 95-%-Intervall der Differenz geändert
history-errors-before = Vorher: RMS-Fehler { $nominal } am Sollroboter, { $identified } nach der Identifikation
history-errors-after = Nachher: RMS-Fehler { $nominal } am Sollroboter, { $identified } nach der Identifikation
history-changed-of = { $changed } von { $all }
history-heading-session = Messung
history-heading-from = Aus
history-heading-samples = Messpunkte
history-heading-rms-error-nominal-mm = RMS-Fehler am Sollroboter, mm
history-heading-model-mm = Modell, mm
history-heading-with-the-earliest-mm = Mit dem frühesten, mm
history-heading-changed = Geändert
history-heading-parameter = Parameter
history-heading-unit = Einheit
history-heading-before = Vorher
history-heading-after = Nachher
history-heading-difference = Differenz
history-heading-beyond-its-interval = Über dem Intervall
history-cell-session = Messung
history-cell-model = Modell
history-cell-not-determined = nicht bestimmt
history-cell-changed = geändert
history-cell-no = nein

## recording

recording-record-from-instrument = Vom Messgerät aufzeichnen
recording-lines-of-text-become = Textzeilen, je eine für einen gemessenen Punkt, werden Messpunkte einer neuen Messung von { $robot }; eine Verbindung, die endet, wird wiederhergestellt
recording-address = Adresse
recording-address-forms = tcp://HOST:PORT oder udp://:PORT
recording-columns = Spalten
recording-empty-the-first-line = leer: die erste Zeile nennt sie
recording-file = Datei
recording-a-new-csv-table = eine neue CSV-Tabelle
recording-type-where-it-sends = Geben Sie ein, wohin die Software des Messgeräts sendet, zum Beispiel tcp://192.168.0.10:4000
recording-columns-such-as = Spalten wie q1_deg, x_mm, y_mm, z_mm; getrennt durch Kommas, Semikolons, Tabulatoren oder Leerzeichen
recording-a-name-that-ends-in-csv = { $path }: erwartet wird ein Name, der auf .csv endet
recording-the-folder-is-not-there = { $folder }: den Ordner gibt es nicht
recording-exists-already = { $path } gibt es schon: eine Aufzeichnung ersetzt nichts
recording-record = Aufzeichnen
recording-stop = Aufzeichnung beenden
recording-left-out-last = Zuletzt ausgelassen: { $line }
recording-stands = Aufzeichnung · { $lines }{ $left_out } · { $state }
recording-lines =
    { $count ->
        [one] { $count } Zeile
       *[other] { $count } Zeilen
    }
recording-left-out = {" "}· { $count } ausgelassen
recording-connecting = verbindet
recording-connected = verbunden
recording-not-connected = nicht verbunden, wird erneut versucht: { $why }

## unexplained

unexplained-unexplained = Unerklärt
unexplained-what-is-left = Rest
unexplained-where = wo
unexplained-a-part-of-it-looks = Ein Teil davon sieht aus wie { $resembles }
unexplained-it-cannot-be-corrected = Nicht korrigierbar: { $because }
unexplained-cross-validated-rms-error-corrected = kreuzvalidierter RMS-Fehler, korrigiert
unexplained-add-smooth-correction = Glatte Korrektur hinzufügen
unexplained-smooth-correction-in-the-model = glatte Korrektur im Modell
unexplained-largest-along-the-motion = größte in Bewegungsrichtung
unexplained-largest-along-the-radius = größte in Radialrichtung
unexplained-largest-along-the-axis = größte in Achsrichtung
unexplained-a-smooth-curve-without = Eine glatte Kurve ohne Namen. Außerhalb des gemessenen Bereichs gelten ihre Endwerte, dort ist nichts bekannt

## fields

fields-the-value-is-kept = { $because }; der Wert bleibt
fields-or-none = {""} oder keine

## grip

grip-width = Breite: { $name }

## text

text-usually = üblich: { $usual_size }
text-what-means = Bedeutung von { $word }

## sample

sample-before-after = vorher → nachher
sample-moving-negative = Bewegung negativ
sample-not-known = nicht bekannt
sample-approached = angefahren
sample-a-value-is-missing = ein Wert fehlt
sample-click-for-more = Klick für mehr
sample-card = Karte von { $title }: { $parts }

## handles

handles-boundary = Grenze bei { $at }°
handles-drag-or-press-the-arrow = ziehen oder die Pfeiltasten drücken; mit Umschalt größere Schritte
handles-no-samples = { $name }: keine Messpunkte
handles-l1-left = { $name }: { $samples }, Δθ { $theta }, Δl1 { $l1 }, Rest { $left }

## layout

layout-this-computer-draws-in-software = dieser Rechner zeichnet in Software
layout-zoom-in-for-more = für mehr hineinzoomen
layout-1 = 1 von { $one_of } { $what }: { $why }
layout-points = Punkten

## paint

paint-workspace-plot-samples = Diagramm des Arbeitsraums, { $samples } Messpunkte

## polar

polar-nothing-was-measured-yet = Es wurde noch nichts gemessen: Die Polaransicht zeigt Abweichungen über den Winkel des Gelenks
polar-this-robot-has-several-joints = Dieser Roboter hat mehrere Gelenke, sodass eine Abweichung zu keinem einzelnen Winkel gehört: Es gibt keine Polaransicht. Die anderen Ansichten zeigen, wo sie liegt, das Diagramm darunter, über welchem Wert des ersten Gelenks
polar-this-joint-slides = Dies ist ein Schubgelenk, und eine Länge schließt keinen Kreis: Es gibt keine Polaransicht. Das Diagramm darunter zeigt die Abweichung entlang des Gelenkwegs
polar-1-division = 1 Teilung = { $length } { $unit }
polar-polar-view-samples = Polaransicht, { $component }, { $samples } Messpunkte, { $polar }
polar-deviation-around-the-angle = Abweichung { $component } über den Winkel
polar-1-division-mm-the-thick = 1 Teilung = { $division } mm; der dicke Kreis ist der Sollkreis
polar-outline-before = Umriss: vorher
polar-outline-before-filled-after = Umriss: vorher, gefüllt: nachher
polar-filled-after = gefüllt: nachher
polar-tip-up-moving-positive-tip = ; Spitze oben: Bewegung positiv, Spitze unten: negativ
polar-dashed-tolerance-mm = ; gestrichelt: Toleranz { $tolerance } mm
polar-1-of-samples = ; 1 von { $stride } Messpunkten

## robot

robot-robot-at-sample = Roboter an Messpunkt { $sample }
robot-robot-at-sample-as = Roboter an Messpunkt { $sample }, als Beispiel
robot-robot-as-posed = Roboter wie eingestellt
robot-robot-at-home = Roboter in Grundstellung
robot-and-more = und { $more } weitere

## scales

scales-legend = Legende: { $name }

## pose

pose-pose = Pose
pose-back-to-sample = Zurück zum Messpunkt
pose-pose-of-joint = Stellung von Gelenk { $k }, { $joint }
pose-from-the-sample = vom gezeigten Messpunkt

## space

space-3-d-view-samples = 3-D-Ansicht, { $samples } Messpunkte, { $camera }
space-sample-selected = , Messpunkt { $sample } gewählt
space-arrow-keys-orbit-plus = Pfeiltasten drehen, Plus und Minus zoomen, Pos1 passt ein; 0, 1, 3 und 7 sind Standardansichten
space-grid = Raster { $square } { $unit }
space-tool = Werkzeug
space-samples-deviations-magnified-times = { $session }: { $samples } Messpunkte, { $camera }, Abweichungen { $state } { $magnified }-fach vergrößert
space-grid-mm = Raster { $square } mm
space-colour = ; Farbe: { $colouring }
space-base = Basis

## toolbar

toolbar-fit-to-view = Ansicht einpassen
toolbar-how-it-is-drawn = Darstellung
toolbar-drawn = Anzeige
toolbar-vectors = Vektoren × { $now }
toolbar-length-of-vectors = Länge der Vektoren
toolbar-3-d = 3-D
toolbar-polar = polar
toolbar-colour = Farbe
toolbar-component-of-the-polar-view = Komponente der Polaransicht
toolbar-both = beide
toolbar-only-after = nur nachher
toolbar-from-before-to-after = Von vorher bis nachher
toolbar-shown-the-deviation-before-measured = gezeigt: Abweichung vorher, gemessen − Sollroboter
toolbar-shown-what-is-left-after = gezeigt: Rest nachher, gemessen − identifizierter Roboter
toolbar-shown-of-the-way = gezeigt: { $percent } % des Weges von vorher bis nachher
toolbar-how-long-vectors-are-drawn = wie lang Vektoren gezeichnet werden und wo die Farben der Längen enden: sodass die Abweichungen vorher oder die verbleibenden nachher lesbar sind
toolbar-scale = Maßstab
toolbar-free = frei
toolbar-standard-view = Standardansicht
toolbar-pose = Pose
toolbar-sliders-that-pose-the-robot = Regler, die den Roboter stellen
toolbar-pose-the-robot = Roboter stellen
toolbar-the-root-mean-square-deviation = das quadratische Mittel der Abweichung zwischen den Messpunkten, das mit der Entfernung verblasst
toolbar-colour-of-vectors = Farbe der Vektoren
toolbar-from = Blick

## chart words

chart-word-before = vorher
chart-word-after = nachher
chart-word-as-measured = Wie gemessen
chart-word-against-the-model = Gegen das Modell
chart-word-moving-positive = Bewegung positiv
chart-word-negative = negativ
chart-word-tolerance = Toleranz
chart-word-noise-floor = Rauschgrenze
chart-word-cross-validated = kreuzvalidiert
chart-word-on-samples-that-no-fit-has-seen = an nicht angepassten Messpunkten
chart-word-the-gap-step-by-step = die Abweichung Schritt für Schritt
chart-word-rms-error = RMS-Fehler
chart-word-nominal-robot = Sollroboter
chart-word-geometry = Geometrie
chart-word-exact-identification = volles Modell
chart-word-full-model = volles Modell
chart-word-by-region = nach Regionen
chart-word-value-95-interval = Wert, 95-%-Intervall
chart-word-changed = geändert
chart-word-by-the-time-of-the-first-sample = nach der Zeit des ersten Messpunkts
chart-word-by-file-name-numbers-in-it-by-their-value = nach Dateinamen, Zahlen darin nach ihrem Wert

## scale

scale-point = Punkt
scale-entry = Eintrag
scale-every-shown = jeder { $stride }. { $what } gezeigt

## examples

example-lamp = Inbetriebnahme einer Leuchte
example-lamp-what = zwei Reflektoren, beide Anfahrrichtungen, Rauschen, während die Maschine warm wird
example-samples = Die 30 Messpunkte der Veröffentlichung
example-samples-what = sechs Regionen mit je fünf Messpunkten, ohne Rauschen
example-run = Die volle Messreihe der Veröffentlichung
example-run-what = 361 Messpunkte, jedes halbe Grad

## effects

effect-on-joint = { $effect }, Gelenk { $joint }
effect-axis-tilt = Achsneigung
effect-axis-wobble = Taumeln der Achse
effect-backlash = Umkehrspiel
effect-base-offset = Basisversatz
effect-bearing-runout = Rundlauffehler des Lagers
effect-encoder-eccentricity = Exzentrizität des Encoders
effect-encoder-two-cycle = Zweiperiodischer Encoderfehler
effect-foundation-compliance = Nachgiebigkeit des Fundaments
effect-frame-drift = Drift des Messsystems
effect-frame-shift = Sprung des Messsystems
effect-gear-transmission-error = Übertragungsfehler des Getriebes
effect-instrument-scale = Maßstabsfehler des Messgeräts
effect-joint-compliance = Nachgiebigkeit des Gelenks
effect-joint-scale = Maßstabsfehler des Gelenks
effect-joint-zero-offset = Nullpunktverschiebung des Gelenks
effect-link-droop = Durchbiegung des Arms
effect-link-geometry = Armgeometrie
effect-link-length = Armlänge
effect-lost-motion = Umkehrspanne (Lost Motion)
effect-measuring-frame = Messkoordinatensystem
effect-screw-pitch = Steigungsfehler der Spindel
effect-thermal-growth = Wärmedehnung
effect-thermal-zero-drift = Thermische Nullpunktdrift
effect-tool-lateral-offset = Seitlicher Werkzeugversatz
effect-tool-orientation = Werkzeugorientierung
effect-tool-position = Werkzeugposition
effect-tracking-lag = Schleppfehler
effect-unexplained-directions = Richtungen des Unerklärten
effect-unknown-anchor = Ankerpunkt
effect-unknown-plane = Ebene
effect-unknown-socket = Aufnahme
effect-unknown-station = Standpunkt
effect-wrist-coupling = Handachskopplung

## glossary words

word-deviation = Abweichung
word-deviation-means = Wo der Reflektor gemessen wurde, minus wo er laut Simulation sein sollte
word-gap = RMS-Fehler
word-gap-means = Quadratisches Mittel der Länge der Abweichung über alle Messpunkte. Vermutete Ausreißer zählen darin nicht, wohl aber in der größten Abweichung
word-largest = Größte Abweichung
word-largest-means = Der am weitesten abliegende Messpunkt, vermutete Ausreißer eingeschlossen
word-tolerance = Toleranz
word-tolerance-means = Wie weit eine gemessene Position abliegen darf. Messpunkte innerhalb sind mit einer Scheibe markiert, außerhalb mit einer Raute
word-noise = Rauschen, ein σ
word-noise-means = Wie sehr die Ablesung des Messgeräts selbst entlang einer Achse streut, nach Hersteller oder Wiederholprüfung. Zwei von drei Ablesungen liegen näher. Ohne Angabe wird es aus den Messpunkten geschätzt
word-floor = Rauschgrenze
word-floor-means = Der RMS-Fehler eines vollkommenen Modells: die Streuung wiederholter Posen oder des Messgeräts. Kein Modell kommt darunter, und eines, das ihr nahekommt, hat nichts mehr zu erklären
word-interval = Intervall, ±
word-interval-means = Der wahre Wert liegt in 19 von 20 solchen Kalibrierungen darin. Es schrumpft mit mehr Messpunkten und mit Posen, die sich stärker unterscheiden
word-held-out = Zurückgehalten
word-held-out-means = Messpunkte, die keine Anpassung gesehen hat. Das Modell muss sie vorhersagen: Ein RMS-Fehler, der auch dort sinkt, ist ein Beleg, einer, der nur bei den anderen sinkt, ist Zufall
word-p-family = Durch Zufall
word-p-family-means = Wie oft bloßes Rauschen irgendeinen Namen der ganzen Liste mindestens so gut aussehen ließe. 1 von 2000 ist ein harter Beleg, 1 von 20 nicht
word-odds = Chancen gegenüber dem nächsten Kandidaten
word-odds-means = Wie viel wahrscheinlicher dieser Name angesichts der Messpunkte ist als der nächstbeste. Unter etwa 20 : 1 bleiben beide möglich, und die Posen, die entscheiden würden, sind aufgeführt
word-share = Anteil
word-share-means = Welchen Teil dessen, was die Identifikation übrig ließ, dieser Name erklärt
word-unexplained = Unerklärt
word-unexplained-means = Es bleibt etwas Regelmäßiges, zu dem kein Name der Liste passt. Es wird gezeigt, wo es liegt, damit dort nachgesehen werden kann
word-limit = Nachweisgrenze
word-limit-means = Die kleinste Größe eines Effekts, die diese Messpunkte gezeigt hätten. Was nicht gefunden wurde, ist kleiner, aber nicht unbedingt null
word-region = Region
word-region-means = Ein Bereich des Gelenks mit eigener konstanter Korrektur, wie ältere Steuerungen sie verlangen
word-correction = Korrektur
word-correction-means = Was zum Sollwert oder zur Position zu addieren ist: die Abweichung mit umgekehrtem Vorzeichen
word-exact = Volles Modell
word-exact-means = Ein Modell für den ganzen Bereich: alle Parameter zugleich, im System des Messgeräts
word-outlier = Vermuteter Ausreißer
word-outlier-means = Ein Messpunkt so weit vom Modell, dass ein Messfehler mindestens viermal wahrscheinlicher ist als Rauschen. Er zählt nicht in der Anpassung, bleibt sichtbar und ist eine erneute Messung wert
word-slow-noise = Langsames Rauschen
word-slow-noise-means = Ein Teil des Fehlers, der mit der Zeit wandert, was immer der Roboter tut: ein sich setzendes Stativ, Luft, ein warm werdender Tracker. Die Intervalle berücksichtigen ihn, und kein Effekt des Roboters wird hineingelesen
word-not-identifiable = Nicht identifizierbar
word-not-identifiable-means = Zwei Ursachen, die auf jeden bisherigen Messpunkt gleich wirken. Stärker verschiedene Posen, ein zweiter Reflektor oder beide Anfahrrichtungen trennen sie meist
word-targets = Kompensierte Zielpunkte
word-targets-means = Zielpunkte einer Tabelle oder eines Programms, deren Zahlen geändert wurden, damit das wirkliche Werkzeug dorthin fährt, wohin der Sollroboter führe. Ein singulärer, jenseits der Grenzen liegender oder mehrdeutiger Zielpunkt wird genannt und bleibt, wie er ist
word-predicted = Positionsfehler laut Modell
word-predicted-means = Wie weit das wirkliche Werkzeug laut Modell von den Zielpunkten der Datei entfernt ist: mit ihren jetzigen Zahlen und mit den korrigierten
word-language = Gelesen als
word-language-means = Die Sprache der Datei, nach ihrer Endung, sonst nach ihrem Aussehen
word-remainder = Durch Gelenkbefehle nicht korrigierbar
word-remainder-means = RMS-Fehler, der bleibt, wenn die Steuerung die ganze Tabelle anwendet: Richtungen, in denen die Bewegung dieses Gelenks nichts bewegt
word-uncertainty = Unsicherheit des Modells
word-uncertainty-means = Wie weit der vom Modell vorhergesagte Punkt falsch sein kann, weil Messungen streuen: eine Standardunsicherheit aus der Kovarianz der Anpassung, an jeder gemessenen Stellung, bei mehreren Gelenken auch an Stellungen über ihre Bereiche. Sie ist klein, wo viele Stellungen das Modell bestimmen. Was kein Parameter des Modells beschreibt, ist nicht darin
word-planar = Ebene Messung
word-planar-means = Nur x und y wurden gemessen; über das Geschehen entlang z ist nichts bekannt
word-direction = Richtung
word-direction-means = Die Seite, von der das Gelenk in die Pose kam. Anfahren von beiden Seiten macht Umkehrspiel sichtbar
word-polar = Polaransicht
word-polar-means = Eine Komponente der Abweichung über den Winkel des Gelenks, wie Kreise einer Kreisformprüfung gezeigt werden (ISO 230-4): Auf dem Sollkreis ist sie null, und ein Ring steht für die oben genannte Länge. Ein Oval ist eine geneigte oder taumelnde Achse, ein verschobener Kreis ein falscher Mittelpunkt, zwei Kreise sind Spiel zwischen beiden Richtungen
word-drawn-robot = Der Roboter im Arbeitsraum
word-drawn-robot-means = Der Sollroboter im Umriss an dem gewählten oder unter dem Zeiger liegenden Messpunkt, daneben als Linie der wirkliche, gemessen oder identifiziert, so vielfach verschoben wie danebensteht. Ohne Auswahl steht er blass an einem Messpunkt in der Mitte
word-over-time = Abweichung über der Zeit
word-over-time-means = Die Abweichung in der Reihenfolge der Messung. Eine Steigung ist eine Drift der Maschine oder des Stativs, eine Stufe der Augenblick, in dem jemand eines davon berührt hat
word-over-load = Abweichung über der Last
word-over-load-means = Die Abweichung über dem Gewicht, das der Arm trug. Eine Steigung ist ein nachgebender Arm oder ein nachgebendes Gelenk; dazu braucht es Posen mit verschiedenen Lasten
word-over-temperature = Abweichung über der Temperatur
word-over-temperature-means = Die Abweichung über der aufgezeichneten Temperatur. Eine Steigung ist ein wachsendes Glied oder ein Gelenk, dessen Nullpunkt beim Erwärmen wandert
word-orders = Ordnungsspektrum
word-orders-means = Wie groß der Teil der Abweichung ist, der ein-, zwei-, dreimal … je Umdrehung des Gelenks wiederkehrt. Einmal ist ein exzentrischer Encoder oder ein exzentrisches Lager, zweimal ein ovales, und ein Getriebe zeigt sich bei seiner Zähnezahl. Balken unter der Rauschlinie bedeuten nichts
word-histogram = Histogramm
word-histogram-means = Wie viele Messpunkte um wie viel abweichen. Bleibt nur Rauschen, füllen die Balken die gestrichelte Kurve; zwei Haufen sind zwei Zustände, wie bei Umkehrspiel. Ein Klick auf einen Balken markiert seine Messpunkte überall
word-effect-curve = Kurve des Effekts
word-effect-curve-means = Was bleibt, wenn das Modell alles außer diesem Effekt kennt, und was der Effekt in seiner angepassten Größe bewirkt. Wo die Kurve durch die Punkte läuft, stimmt der Name
word-setup = Aufstellung
word-setup-means = Ein Standort des Messgeräts. Jeder hat ein eigenes Messsystem, das angepasst wird
word-tool = Werkzeugpose
word-tool-means = Position und Orientierung des Werkzeugsystems im Basissystem, wenn jedes Gelenk auf null steht
word-robot = Roboter
word-robot-means = Die Beschreibung, an der gemessen wurde: Achsen, Reflektoren und Glieder laut Zeichnung. Alles wird dagegen gemessen
word-samples = Messpunkte
word-samples-means = Gemessene Posen. Mehr davon und stärker verschiedene machen jede Zahl sicherer
word-reflectors = Reflektoren
word-reflectors-means = Punkte am Werkzeug, die das Messgerät sieht. Ein zweiter bei anderem Radius trennt Ursachen, die einer allein nicht trennen kann
word-instrument = Messgerät
word-instrument-means = Womit die Positionen gemessen wurden. Sein Rauschen ist der kleinste RMS-Fehler, den ein Modell erreichen kann
word-compensated = Kompensiert
word-compensated-means = Die Sollwerte waren bei der Messung schon durch eine Tabelle korrigiert: Hier ist zu sehen, was diese Tabelle übrig ließ
word-range = Gemessener Bereich
word-range-means = Die kleinste und die größte gemessene Stellung des Gelenks. Außerhalb ist nichts bekannt, und eine Tabelle hält dort ihre Endwerte
word-hole = Größte Lücke
word-hole-means = Ein Teil des Bereichs, viel breiter als die anderen Schritte, in dem kein Messpunkt liegt. Was dort geschieht, bleibt unbemerkt: Messen Sie einige Posen darin
word-speed = Geschwindigkeit
word-speed-means = Wie schnell sich das Gelenk bei der Messung bewegte. Nachlauf hinter dem Sollwert zeigt sich nur bei verschiedenen Geschwindigkeiten
word-load = Last
word-load-means = Die Masse am Werkzeug bei der Messung. Biegung von Gliedern und Gelenken zeigt sich nur bei verschiedenen Lasten
word-temperature = Temperatur
word-temperature-means = Des Roboters bei der Messung. Wärmedehnung zeigt sich nur, wo sie sich um einige Grad ändert
word-took = Dauer
word-took-means = Vom ersten bis zum letzten Messpunkt. Was driftet oder angestoßen wurde, zeigt sich nur, wo Messpunkte eine Zeit haben
word-shows = Prüfbare Effekte
word-shows-means = Wie viele der physikalischen Ursachen, die dieses Programm kennt, in diesen Messpunkten eine Spur hinterließen. Was nicht prüfbar ist, kann trotzdem da sein
word-without = Ohne sie
word-without-means = RMS-Fehler des Sollroboters: was bleibt, wenn nichts korrigiert wird
word-modelled = Modell und Messung
word-modelled-means = RMS-Fehler zwischen der Messung und dem identifizierten Modell: was eine vollkommene Steuerung erreichen könnte, wenn jede Richtung korrigierbar wäre
word-corrected = Mit korrigierten Sollwerten
word-corrected-means = RMS-Fehler, der bei dieser Messung bleibt, wenn die Sollwerte mit dem Modell korrigiert werden
word-entries = Einträge
word-entries-means = Zeilen der Tabelle. Mehr davon folgen der Kurve genauer; eine Steuerung erlaubt vielleicht nur eine begrenzte Zahl
word-source = Herkunft
word-source-means = Die Datei und die Messung, aus der das Modell identifiziert wurde. Ein Modell ist so viel wert, wie seine Messung abdeckt
word-place = Wo
word-place-means = Der Teil des Bereichs oder die Zahl der Perioden je Umdrehung, bei der der Rest auffällt: Sehen Sie dort an der Maschine nach
word-curve = Größter Wert der Kurve
word-curve-means = Das Meiste, um das die glatte Korrektur den Punkt in dieser Richtung bewegt
word-axis = Achse
word-axis-means = Die Linie, um die oder entlang der sich ein Gelenk bewegt, wenn jedes Gelenk auf null steht: eine Richtung und ein Punkt darauf, im Basissystem
figure-a = Genauigkeit: von der kleinsten bis zur größten Abweichung irgendwo auf der Achse, mit der doppelten Streuung auf beiden Seiten
figure-a-one-way = Dasselbe für nur eine Anfahrrichtung: was bleibt, wo ein Programm immer von einer Seite kommt
figure-e = Systematische Abweichung: von der kleinsten bis zur größten mittleren Abweichung, ohne die Streuung. Das kann eine Tabelle beseitigen
figure-e-one-way = Dasselbe für nur eine Anfahrrichtung
figure-m = Vom kleinsten bis zum größten Mittel beider Richtungen: die Form des Fehlers entlang der Achse
figure-r = Wiederholpräzision: wie weit Rückkehren zu einer Position schlimmstenfalls streuen, beide Richtungen zusammen. Keine Tabelle kann sie beseitigen
figure-b = Umkehrspanne: wie weit die beiden Anfahrrichtungen schlimmstenfalls auseinanderliegen. Umkehrspiel und Lost Motion zeigen sich hier
figure-b-mean = Dasselbe im Mittel entlang der Achse
figure-ap = Posegenauigkeit: vom Sollpunkt zur Mitte der gemessenen Punkte
figure-rp = Pose-Wiederholgenauigkeit: Radius der Kugel, die die Rückkehren zu einer Pose enthält, Mittel plus drei Standardabweichungen
figure-vap = Wie weit die Mitten auseinanderliegen, wenn eine Pose von verschiedenen Seiten angefahren wird
