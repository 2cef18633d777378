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
compensation-tool-of-the-program = Werkzeug des Programms
compensation-frame-of-the-program = Bezugssystem des Programms
compensation-as-modelled = das des Modells (--as-modelled)
compensation-as-programmed = wie im Programm (--as-programmed)
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

import-more-options = Weitere Angaben zu dieser Art von Datei
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
recovery-discard-all-for-good = Alle { $count } endgültig verwerfen
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
text-size-from-to = { $from } bis { $to }
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

## what the core says

finding-expected = { $found }; erwartet: { $expected }
finding-at = { $place }: { $found }

# The core: causes of effects

core-the-column-does-not-stand-upright = die Säule steht nicht senkrecht auf dem Sockel
core-the-bearings-raceways-are-wavy-so = die Laufbahnen des Lagers sind wellig, sodass die Achse beim Drehen kippt
core-play-between-gear-teeth-in-a = Spiel zwischen Zähnen, in einer Kupplung oder einer Passfeder
core-the-measuring-frame-was-surveyed-to = das Messkoordinatensystem wurde auf einen Punkt neben der Achse eingemessen
core-raceways-or-seats-of-the-bearing = Laufbahnen oder Sitze des Lagers sind unrund
core-the-encoders-ring-or-the-gear = der Ring des Encoders oder das Zahnrad, das ihn treibt, sitzt außermittig
core-the-encoder-ring-is-tilted-or = der Encoderring ist verkippt oder oval, oder eine Kupplung zwischen Encoder und Welle ist verbogen
core-the-pedestal-the-floor-or-the = der Sockel, der Boden oder die Schrauben des Fußes geben unter dem Moment von Last und Arm nach
core-the-tripod-settles-or-the-base = das Stativ setzt sich, oder der Fuß kriecht
core-somebody-touched-the-tripod-or-the = jemand hat das Stativ berührt, oder der Fuß ist verrutscht
core-tooth-or-wavegenerator-errors-in-the = Fehler der Verzahnung oder des Wellengenerators im Getriebe; die Ordnung sagt, welches Rad
core-the-instruments-distance-scale-or-its = der Maßstab des Messgeräts oder seine Werte für Lufttemperatur und Luftdruck stimmen nicht
core-reducer-bearing-and-shaft-wind-up = Getriebe, Lager und Welle verdrehen sich unter dem Gewicht, das am Gelenk hängt
core-the-gear-ratio-or-the-encoders = die Übersetzung oder die Encoderschritte je Umdrehung sind nicht ganz richtig eingetragen
core-the-reference-mark-or-the-homing = die Referenzmarke oder die Referenzposition ist nicht dort, wo die Steuerung sie annimmt
core-the-link-or-the-structure-bends = der Arm oder die Struktur biegt sich unter der Last
core-links-are-longer-or-shorter-than = Arme sind länger oder kürzer als gezeichnet, Achsen sind nicht rechtwinklig oder nicht parallel
core-the-tool-or-the-link-is = Werkzeug oder Arm ist länger oder kürzer als in den Daten der Steuerung
core-friction-in-the-reducer-winds-the = Reibung im Getriebe verspannt den Antrieb nach jeder Umkehr
core-the-instrument-stands-where-it-was = das Messgerät steht, wo es aufgestellt wurde
core-the-thread-of-the-screw-is = das Gewinde der Spindel ist ungleichmäßig, oder ihr Lager oder der Encoder darauf läuft unrund
core-the-arm-grows-as-it-warms = der Arm dehnt sich bei Erwärmung: Stahl um etwa 12 ppm/K, Aluminium um 23
core-the-encoders-mounting-or-the-reducer = die Encoderbefestigung oder das Getriebe dreht sich bei Erwärmung ein wenig
core-the-tool-is-mounted-beside-the = das Werkzeug sitzt neben dem Radius, den die Steuerung annimmt
core-the-tool-is-mounted-turned-or = das Werkzeug ist verdreht montiert, oder seine Daten in der Steuerung sind es
core-the-tool-data-in-the-controller = die Werkzeugdaten der Steuerung oder der Ort des Reflektors am Werkzeug
core-the-position-loop-follows-late-or = der Lageregler folgt verspätet, oder die Uhren von Messgerät und Steuerung weichen ab
core-unknown-no-effect-of-the-catalogue = unbekannt: kein Effekt des Katalogs erklärt es
core-the-drive-of-one-joint-turns = der Antrieb eines Gelenks dreht ein anderes mit, und das Verhältnis dafür in der Steuerung ist nicht genau

# The core: what to check

core-shim-the-columns-foot-level-it = den Fuß der Säule unterlegen; entlang x und y ausrichten
core-the-bearings-axial-seat-and-preload = axialer Sitz und Vorspannung des Lagers
core-preload-and-wear-of-the-reducer = Vorspannung und Verschleiß des Getriebes; den Abtrieb bei gehaltenem Antrieb von Hand hin und her bewegen
core-survey-the-base-again = den Sockel neu einmessen
core-the-bearings-seat-and-preload = Sitz und Vorspannung des Lagers
core-centre-the-encoder-ring-or-average = den Encoderring zentrieren oder mit einem zweiten Lesekopf bei 180° mitteln
core-check-the-rings-mounting-face-for = die Anlagefläche des Rings auf Verkippung und den Ring auf Rundheit prüfen
core-the-bolts-and-the-pedestal-a = die Schrauben und den Sockel; eine Messuhr am Fuß, während der belastete Arm herumschwenkt
core-tripod-clamps-and-the-sun-on = Stativ, Klemmen und Sonne auf den Stativbeinen
core-return-to-the-datum-points-after = nach dem Sprung die Bezugspunkte wieder messen; Klemmen und Stativ
core-compare-the-order-with-the-reducers = die Ordnung mit den Zähnezahlen des Getriebes vergleichen, dann Vorspannung und Schmierung
core-measure-a-scale-bar-the-instruments = einen Maßstab messen; die Wetterstation des Messgeräts
core-the-payload-entered-in-the-controller = die Nutzlast in der Steuerung; die Steifigkeit des Getriebes laut Datenblatt
core-compare-the-gear-ratio-and-the = Übersetzung und Schritte je Umdrehung in der Steuerung mit den Datenblättern vergleichen
core-home-the-joint-again-and-repeat = das Gelenk neu referenzieren und drei Posen wiederholen
core-the-bolts-between-base-column-and = die Schrauben zwischen Sockel, Säule und Arm
core-the-kinematic-data-in-the-controller = die kinematischen Daten in der Steuerung
core-the-tool-data-in-the-controller-2 = die Werkzeugdaten in der Steuerung
core-lubrication-and-preload-of-the-reducer = Schmierung und Vorspannung des Getriebes
core-measure-reference-points-on-the-base = in jeder Aufstellung Referenzpunkte am Sockel messen
core-the-screws-runout-and-its-thrust = der Rundlauf der Spindel und ihr Axiallager; die Kupplung und der Encoder auf der Spindel
core-let-the-machine-warm-up-before = die Maschine vor dem Messen warmlaufen lassen oder die Dehnung des Arms in der Steuerung eintragen
core-let-the-machine-warm-up-before-homing = die Maschine vor dem Referenzieren warmlaufen lassen; nach einer Wärmequelle am Encoder suchen
core-the-tool-flange-and-the-tool = der Werkzeugflansch und die Werkzeugdaten in der Steuerung
core-measure-the-targets-on-the-tool = die Reflektoren am Werkzeug einmessen
core-synchronise-the-clocks-then-the-loops = die Uhren synchronisieren, dann Geschwindigkeitsverstärkung und Vorsteuerung des Reglers
core-look-at-the-machine-where-the = die Maschine dort ansehen, wo das Gelenk in diesem Bereich steht: Maßstab, Lager, Kabel, Abdeckung
core-the-coupling-ratio-in-the-controllers = das Kopplungsverhältnis in den Daten der Steuerung

# The core: usual sizes

core-any = beliebig
core-10-m-of-eccentricity-on-a = 10 µm Exzentrizität an einem Ring mit 50 mm Radius sind 0.011°
core-005-to-1-mm-005-to = 0.05 bis 1 mm, 0.05 bis 2 mrad
core-012-to-023-mm-per-metre = 0.12 bis 0.23 mm je Meter und 10 K

# The core: parameters

core-about-x = um x
core-about-y = um y
core-about-z = um z
core-amplitude = Amplitude
core-compliance = Nachgiebigkeit
core-delay = Verzögerung
core-delta = Änderung
core-fade = Abklingen
core-from-joint = vom Gelenk
core-lead = Steigung
core-offset = Versatz
core-order = Ordnung
core-phase = Phase
core-rate = Rate
core-ratio = Verhältnis
core-scale = Maßstab
core-time = Zeit
core-width = Breite

# The core: what stays, and what to do about it

core-of-joint-leaves = { $a } von Gelenk { $b } lässt { $c } übrig: { $d }
core-leaves = { $a } lässt { $b } übrig: { $c }
core-its-part-along-the-radius-belongs = sein Anteil entlang des Radius gehört in die Werkzeugdaten (l1) oder die Basisdaten der Steuerung; das volle Modell sagt, in welche
core-needs-a-mechanical-repair = braucht eine mechanische Reparatur: { $a }
core-let-the-machine-warm-up-or = die Maschine warmlaufen lassen oder die Dehnung des Arms in der Steuerung eintragen
core-move-the-tool-in-the-controllers = das Werkzeug in den Werkzeugdaten der Steuerung um { $a } quer zum Radius verschieben
core-turn-the-base-in-the-controller = die Basis in der Steuerung um { $a } um x und { $b } um y drehen oder den Fuß der Säule unterlegen
core-along-the-radius-set-the-tools = entlang des Radius; den Werkzeugradius (l1) in der Steuerung von { $a } auf { $b } setzen
core-move-the-base-in-the-controller = die Basis in der Steuerung um { $a } verschieben oder neu einmessen
core-the-joint-stands-beyond-its-command = das Gelenk steht { $a } jenseits seines Sollwerts: den Nullpunkt in der Steuerung korrigieren oder neu referenzieren
core-move-the-tools-point-in-the = den Werkzeugpunkt in der Steuerung um { $a } im Werkzeugkoordinatensystem verschieben

# The core: tables

core-the-numbers-are-corrections-add-them = die Zahlen sind Korrekturen: Sie werden zum Sollwert addiert, damit der Roboter dort ankommt, wohin er sollte (die Abweichung, gemessen − befohlen, hat das andere Vorzeichen)
core-the-numbers-are-deviations-actual-commanded = die Zahlen sind Abweichungen, Ist − Soll: Die Steuerung zieht sie vom Sollwert ab (die Korrektur, die addiert wird, hat das andere Vorzeichen)
core-commanded-robot-reached-table-says-send = befohlen { $a }, der Roboter erreichte { $b }, die Tabelle sagt { $c }: senden Sie { $d }
core-with-this-table-the-controller-leaves = mit dieser Tabelle lässt die Steuerung { $a } über den gemessenen Bereich übrig, eine genaue Korrektur { $b }; { $c }
core-its-entries-add-less-than = ihre { $a } Einträge tragen { $b } bei, weniger als { $c } ({ $d })
core-its-entries-add-more-than-the = ihre { $a } Einträge tragen { $b } bei, mehr als { $c } ({ $d }): die Schrittweite ist groß
core-its-entries-add-more-than-takes = ihre { $a } Einträge tragen { $b } bei, mehr als { $c } ({ $d }): { $e } nimmt höchstens { $f }
core-1-of-the-tolerance = 1 % der Toleranz
core-1-of-001-mm-as-there = 1 % von 0.01 mm, da es keine Toleranz gibt
core-1-of-the-models-rms-error = 1 % des RMS-Fehlers des Modells, da es keine Toleranz gibt
core-the-joint-has-no-limits-the = das Gelenk hat keine Grenzen: Die Tabelle deckt den gemessenen Bereich ab
core-a-step-of-does-not-divide = eine Schrittweite von { $a } teilt den Verfahrweg nicht: Die Schritte sind { $b }
core-measured-from-to-outside-the-correction = gemessen von { $a } bis { $b }; außerhalb gilt die Korrektur am Ende dieses Bereichs weiter
core-the-of-this-joint-depends-on = { $a } dieses Gelenks hängt von den anderen Gelenken ab: Sie stehen hier in der Grundstellung
core-the-correction-jumps-at-the-boundaries = die Korrektur springt an den Grenzen der Regionen; zwischen zwei Einträgen macht die Tabelle daraus eine Rampe
core-up-to-of-it-is-an = bis zu { $a } davon sind eine unerklärte glatte Korrektur, gemessen von { $b } bis { $c }: Kein Effekt des Katalogs erklärt sie, und außerhalb gelten ihre Endwerte weiter

# The core: targets and programs

core-poses-for-which-the-file-declares = Posen, für die die Datei kein Koordinatensystem nennt, werden { $a } gelesen; das Werkzeug der Steuerung muss das des Modells sein, wo die Datei nur ein Werkzeug hat
core-in-the-robots-base-frame = im Basiskoordinatensystem des Roboters
core-in-the-frame-that-was-stated = im angegebenen Koordinatensystem
core-the-robots-base-is-the-frame = die Basis des Roboters ist das Koordinatensystem, in dem gemessen wurde
core-the-robots-base-is-where-its = die Basis des Roboters ist dort, wo seine erste Achse ist; das Messkoordinatensystem steht { $a } und { $b } davon entfernt (--measured-frame korrigiert auf dieses)
core-targets-without-a-load-are-corrected = Zielpunkte ohne Last werden für { $a } korrigiert
core-targets-without-a-temperature-are-corrected = Zielpunkte ohne Temperatur werden für { $a } korrigiert

# The core: tolerance

core-pass = Bestanden
core-fail = Nicht bestanden
core-neither-pass-nor-fail-is-proven = Weder bestanden noch nicht bestanden ist nachgewiesen
core-largest-deviation-expanded-uncertainty-u-k = größte Abweichung { $a } ({ $b }), erweiterte Unsicherheit U = { $c } (k = 2), Toleranz { $d }; Entscheidungsregel: { $e }
core-predicted-with-corrected-commands = vorhergesagt mit korrigierten Sollwerten
core-as-measured-with-the-table-active = wie mit aktiver Tabelle gemessen
core-simple-acceptance-jcgm-106-82 = einfache Annahme (JCGM 106, 8.2)
core-no-position-was-measured = es wurde keine Position gemessen
core-no-command-can-be-corrected = kein Sollwert kann korrigiert werden
core-the-noise-of-the-instrument-is = das Rauschen des Messgeräts ist nicht bekannt

# The core: noise and fit

core-the-measuring-frame-wanders-by-root = das Messkoordinatensystem wandert um { $a } (quadratisches Mittel) innerhalb von { $b }
core-a-part-of-the-remaining-error = ein Teil des Restfehlers setzt sich von Messpunkt zu Messpunkt fort, { $a } (quadratisches Mittel) innerhalb von { $b }: Eine Diagnose sucht darin nach Effekten
core-as-found-as-stated-for-the = σ = { $a } wie gefunden, { $b } wie für das Messgerät angegeben ({ $c }-fach)
core-a-joint-value-or-a-coordinate = ein Gelenkwert oder eine Koordinate fehlt
core-the-instrument-lost-the-reflector-it = das Messgerät hat den Reflektor verloren: Es schrieb 0, 0, 0
core-by-hand = von Hand
core-converged = konvergiert
core-there-was-nothing-to-solve-for = es gab nichts zu bestimmen
core-stopped-after-the-largest-number-of = nach der größten Zahl von Schritten angehalten: Das Ergebnis kann grob sein
core-stopped-where-no-step-made-the = angehalten, wo kein Schritt die Anpassung verbesserte: Das Ergebnis kann grob sein
core-cancelled = abgebrochen
core-z-is-not-used-the-method = z wird nicht verwendet: Das Verfahren arbeitet in der Ebene, in der die Achse das Werkzeug bewegt
core-corrections-are-constant-in-the-base = Korrekturen sind innerhalb einer Region im Basissystem konstant: Ein konstanter Fehler des Gelenks sieht in jeder Region anders aus, und ein Teil bleibt; das volle Modell hat keine dieser Grenzen
core-no-sample-in-region-no-correction = kein Messpunkt in Region { $a }: dort keine Korrektur
core-samples-lie-in-no-region-and = { $a } Messpunkte liegen in keiner Region und wurden nicht verwendet
core-the-targets-do-not-sit-where = die Reflektoren sitzen nicht innerhalb von targets_sigma_mm dort, wo die Messung sagt: Ihre Orte werden frei angepasst
core-beyond-what-is-usual-by-more = mehr als das Vierfache des Üblichen und ohne Vorwissen angepasst: { $a }
core-the-measuring-frame-was-never-aligned = das Messkoordinatensystem wurde nie auf die Basis des Roboters ausgerichtet (gedreht um { $a }, verschoben um { $b }): Es wird frei angepasst
core-the-samples-do-not-depend-on = die Messpunkte hängen nicht davon ab: Es wird auf null gehalten
core-the-samples-do-not-depend-on-it = die Messpunkte hängen nicht davon ab
core-the-samples-show-only-their-sum = die Messpunkte zeigen nur ihre Summe: { $a } wird auf null gehalten, die anderen tragen es
core-the-samples-show-only-their-sum-a = die Messpunkte zeigen nur ihre Summe: Eine Änderung des einen können die anderen aufheben
core-overall-size-all-lengths-of-the = Gesamtgröße: alle Längen des Roboters und der Orte zusammen
core-the-base-is-open-what-was = die Basis ist offen: Was gemessen wurde, bezieht sich auf unbekannte Orte und sagt nicht, wo der Roboter steht; sie bleibt, wo sie ist, und die Orte tragen es

# The core: a model on other samples

core-the-sessions-robot-has-than-the = der Roboter der Messung hat { $a } als der des Modells: Der nominelle Roboter des Modells wird verwendet
core-another-tool = ein anderes Werkzeug
core-other-axes = andere Achsen
core-the-session-was-measured-with-this = gemessen wurde mit der aktiven Tabelle dieses Modells: Die Messung zeigt, was bleibt, und wird nicht ein zweites Mal korrigiert
core-the-session-was-measured-with-another = gemessen wurde mit der aktiven Tabelle eines anderen Modells: Die Messung wird nicht ein zweites Mal korrigiert, und dieses Modell weiß nicht, was jene Tabelle tat
core-belong-to-the-session-that-the = { $a } gehören zu der Messung, aus der das Modell stammt, und werden weggelassen
core-the-model-knows-no-setup-its = das Modell kennt keine Aufstellung { $a }: Ihr Koordinatensystem wird an diese Messpunkte angepasst
core-not-known-to-the-model-and = dem Modell unbekannt und neben ihm bestimmt: { $a }

# The core: tables of several joints

core-the-table-cancels-what-joint-does = die Tabelle hebt auf, was Gelenk { $a } an seinem eigenen { $b } bewirkt; Fehler der Geometrie hängen von allen Gelenken ab und gehören in die kinematischen Daten der Steuerung
core-angle = Winkel
core-travel = Weg

# The core: held out

core-each-fifth-of-the-measurements-of = jedes Fünftel der Messungen, je Bezug ein eigenes, vorhergesagt von einer Anpassung, die es nicht gesehen hat
core-each-of-cells-of-the-workspace = jede von { $a } Zellen des Arbeitsraums vorhergesagt von einer Anpassung, die sie nicht gesehen hat
core-each-fifth-of-the-cells-of = jedes Fünftel der Zellen des Arbeitsraums vorhergesagt von einer Anpassung, die es nicht gesehen hat
core-the-samples-that-the-session-marks = die Messpunkte, die die Messung als zurückgehalten kennzeichnet; keine Anpassung hat sie berührt
core-too-few-samples-to-hold-any = zu wenige Messpunkte, um welche zurückzuhalten

# The core: what is left without a name

core-no-effect-of-the-catalogue-explains = { $a }; kein Effekt des Katalogs erklärt es
core-the-base-model-does-not-fit = das Grundmodell passt nicht: Achsen, Werkzeug oder Massen; { $a }
core-what-is-left-looks-most-like = was bleibt, sieht am ehesten aus wie { $a }
core-the-search-stopped-at-its-limit = die Suche endete an ihrer Grenze von { $a } Effekten; { $b }
core-the-remaining-error-of-is-times = der Restfehler von { $a } ist das { $b }-Fache dessen, was { $c }, ohne eine Struktur, die die Suche kennt
core-the-remaining-error-is-times-what = der Restfehler ist das { $a }-Fache dessen, was { $b }, ohne eine Struktur, die die Suche kennt
core-returns-to-the-same-pose-show = Rückkehren zur selben Pose zeigen
core-returns-to-the-same-pose-show-2 = Rückkehren zur selben Pose zeigen ({ $a })
core-is-stated-for-the-instrument = für das Messgerät angegeben ist
core-is-stated-for-the-instrument-2 = für das Messgerät angegeben ist ({ $a })
core-over-the-value-of-joint = { $a } über dem Wert von Gelenk { $b }, { $c }
core-over-time = { $a } über der Zeit, { $b }
core-over-the-side-from-which-joint = { $a } über der Seite, von der Gelenk { $b } kam, { $c }
core-over-the-speed-of-joint = { $a } über der Geschwindigkeit von Gelenk { $b }, { $c }
core-over-the-load = { $a } über der Last, { $b }
core-over-temperature = { $a } über der Temperatur, { $b }
core-of-one-reflector-against-the-others = { $a } eines Reflektors gegen die anderen, { $b }
core-a-constant = eine Konstante
core-a-straight-slope = eine gerade Steigung
core-a-slope-away-from-the-middle = eine Steigung von der Mitte weg
core-a-parabola = eine Parabel
core-a-curve-of-no-known-form = eine Kurve ohne bekannte Form
core-a-local-bump = eine örtliche Beule
core-a-step-or-plateau = eine Stufe oder ein Plateau
core-a-slope-from-one-value-on = eine Steigung ab einem Wert
core-a-wave = eine Welle
core-a-periodic-pattern-with-harmonics = ein periodisches Muster mit Oberwellen
core-a-wave-of-one-turn-in = eine anteilige Welle von einer Umdrehung
core-along-the-motion-of-joint = entlang der Bewegung von Gelenk { $a }
core-along-the-radius = entlang des Radius
core-along-the-axis = entlang der Achse
core-in-the-measuring-frame = im Messkoordinatensystem
core-with-the-moving-body = mit dem bewegten Körper
core-joint-from-to = Gelenk { $a } von { $b } bis { $c }
core-speed-of-joint-from-to = Geschwindigkeit von Gelenk { $a } von { $b } bis { $c }
core-time-from-to = Zeit von { $a } bis { $b }
core-load-from-to = Last von { $a } bis { $b }
core-temperature-from-to = Temperatur von { $a } bis { $b }
core-cycles-per-turn-of = { $a } Perioden je Umdrehung von { $b }
core-cycles-per-metre-of = { $a } Perioden je Meter von { $b }
core-joint = Gelenk { $a }
core-speed-of-joint = Geschwindigkeit von Gelenk { $a }
core-side-from-which-joint-came = Seite, von der Gelenk { $a } kam
core-load = Last
core-temperature = Temperatur

# The core: what tells explanations apart

core-measure-the-proposed-pose = die vorgeschlagene Pose messen
core-measure-the-proposed-pose-with = die vorgeschlagene Pose mit { $a } messen
core-measure-the-proposed-poses = die { $a } vorgeschlagenen Posen messen
core-measure-the-proposed-poses-with = die { $a } vorgeschlagenen Posen mit { $b } messen
core-a-reflector-at-another-radius = einem Reflektor auf anderem Radius
core-other-speeds = anderen Geschwindigkeiten
core-other-loads = anderen Lasten
core-another-temperature = anderer Temperatur
core-no-pose-within-the-limits-tells = keine Pose innerhalb der Grenzen unterscheidet sie; { $a }
core-approach-the-same-places-from-both = dieselben Stellen von beiden Seiten anfahren
core-measure-in-motion-at-two-speeds = auch in Bewegung bei zwei Geschwindigkeiten messen
core-measure-without-and-with-a-load = ohne und mit Last messen
core-measure-with-the-machine-cold-and = bei kalter und warmer Maschine messen, und noch einmal, während sie abkühlt
core-spread-the-poses-over-the-whole = die Posen über den ganzen Verfahrweg verteilen
core-mount-a-second-reflector-at-another = einen zweiten Reflektor auf anderem Radius anbringen
core-write-down-the-time-of-every = die Zeit jedes Messpunkts aufschreiben (time_s)
core-measure-z-as-well = auch z messen
core-give-the-direction-of-gravity-in = die Richtung der Schwerkraft in der Roboterdatei angeben (gravity_m_s2)
core-the-joint-turns-the-effect-needs = das Gelenk dreht, der Effekt braucht ein schiebendes
core-the-joint-slides-the-effect-needs = das Gelenk schiebt, der Effekt braucht ein drehendes
core-the-joint-was-measured-at-different = das Gelenk wurde bei { $a } verschiedenen Werten gemessen, mindestens { $b } sind nötig
core-the-session-does-not-say-from = die Messung sagt nicht, von welcher Seite die Posen angefahren wurden
core-every-pose-was-approached-from-the = jede Pose wurde von derselben Seite angefahren
core-the-session-does-not-say-how = die Messung sagt nicht, wie schnell sich das Gelenk beim Messen bewegte
core-every-pose-was-measured-at-standstill = jede Pose wurde im Stillstand gemessen
core-every-pose-was-measured-at-the = jede Pose wurde bei derselben Geschwindigkeit gleichen Vorzeichens gemessen
core-the-session-has-no-temperature = die Messung hat keine Temperatur
core-the-temperature-never-changed = die Temperatur hat sich nie geändert
core-the-session-has-no-time = die Messung hat keine Zeit
core-every-sample-has-the-same-time = jeder Messpunkt hat dieselbe Zeit
core-the-direction-of-gravity-is-not = die Richtung der Schwerkraft ist nicht angegeben
core-the-session-has-no-load = die Messung hat keine Last
core-the-load-never-changed = die Last hat sich nie geändert
core-the-robot-has-several-joints-link = der Roboter hat mehrere Gelenke: Die Armgeometrie tritt an seine Stelle
core-the-tool-lies-on-the-axis = das Werkzeug liegt auf der Achse und hat keinen Radius
core-z-was-not-measured-and-the = z wurde nicht gemessen, und der Effekt wirkt entlang der Achse
core-in-these-samples-it-cannot-be = in diesen Messpunkten lässt es sich nicht von der Geometrie unterscheiden: Koordinatensystem, Nullpunkte, Arme und Werkzeug
core-in-these-samples-it-cannot-be-told = in diesen Messpunkten lässt es sich nicht von Nullpunktverschiebung und Armlänge unterscheiden

# The core: mistakes of the set-up

core-in-these-samples-the-same-as = { $a }; in diesen Messpunkten dasselbe wie: { $b }
core-joint-counts-the-other-way-round = Gelenk { $a } zählt andersherum
core-reverse-the-sign-of-joint-in = das Vorzeichen von Gelenk { $a } in der Roboterbeschreibung oder in den Messpunkten umkehren
core-joints-and-are-exchanged = die Gelenke { $a } und { $b } sind vertauscht
core-exchange-the-columns-of-joints-and = die Spalten der Gelenke { $a } und { $b } vertauschen
core-the-measured-points-follow-the-joint = die gemessenen Punkte folgen den rückgelesenen Gelenkwerten, nicht den befohlenen
core-start-from-the-values-read-back = von den rückgelesenen Werten ausgehen (--joint-values read) und prüfen, woher die Sollwerte kommen
core-joints-and-are-coupled-parallelogram-but = die Gelenke { $a } und { $b } sind gekoppelt (Parallelogramm), wurden aber als ungekoppelt gelesen
core-joints-and-are-uncoupled-but-were = die Gelenke { $a } und { $b } sind ungekoppelt, wurden aber als gekoppelt (Parallelogramm) gelesen
core-the-home-position-of-joint-is = die Grundstellung von Gelenk { $a } liegt um { $b } daneben
core-add-to-joint-at-home-or = zu Gelenk { $b } in der Grundstellung { $a } addieren oder das Gelenk neu referenzieren
core-the-home-positions-of-joints-and = die Grundstellungen der Gelenke { $a } und { $b } liegen um 180° daneben
core-correct-the-unit-in-the-headings = die Einheit in den Überschriften der Gelenke berichtigen
core-correct-the-unit-in-the-heading = die Einheit in der Überschrift von { $a } berichtigen
core-correct-the-unit-in-the-headings-of = die Einheit in den Überschriften von x, y und z berichtigen
core-two-of-the-measured-axes-are = zwei der gemessenen Achsen sind vertauscht (etwa x und y), oder eine ist umgekehrt
core-the-measured-axes-are-swapped = die gemessenen Achsen { $a } sind vertauscht
core-x-and-y = x und y
core-y-and-z = y und z
core-x-and-z = x und z
core-x-y-and-z-read-as = x, y und z (gelesen als y, z, x)
core-x-y-and-z-read-as-z = x, y und z (gelesen als z, x, y)
core-exchange-the-headings-of-the-measured = die Überschriften der gemessenen Spalten vertauschen
core-exchange-the-headings-of-the-measured-columns = die Überschriften der gemessenen Spalten vertauschen oder eine davon umkehren
core-the-measuring-frame-was-never-aligned-with = das Messkoordinatensystem wurde nie auf die Basis des Roboters ausgerichtet
core-align-the-instrument-turned-by-moved = das Messgerät ausrichten (gedreht um { $a }, verschoben um { $b }) oder den Messpunkten eine Spalte `setup` geben, damit das Koordinatensystem angepasst wird
core-with-the-frame-the-tool-and = mit angepasstem Koordinatensystem, Werkzeug und Nullpunkten ist der mittlere Fehler (Median) { $a } wie vorliegend und { $b } ohne den Irrtum
core-with-zero-offset-and-link-length = mit angepasstem Nullpunkt und Armlänge ist der RMS-Fehler { $a } wie vorliegend und { $b } ohne den Irrtum
core-far-beyond-what-adjusting-could-mend = weit jenseits dessen, was eine Anpassung beheben könnte
core-the-median-error-is-as-it = der mittlere Fehler (Median) ist { $a } wie vorliegend und { $b } mit angepasstem Koordinatensystem
core-no-geometry-fits-the-samples-as = keine Geometrie passt zu den Messpunkten, wie sie sind; mit angepasstem Koordinatensystem ist der mittlere Fehler (Median) { $a }
core-the-instrument-lost-the-reflector-in = das Messgerät hat den Reflektor verloren in { $a }
core-it-wrote-0-0-0 = es schrieb 0, 0, 0
core-these-samples-are-left-out-measure = diese Messpunkte werden weggelassen; messen Sie sie neu
core-the-instrument-saw-reflector-instead-in = das Messgerät sah stattdessen den Reflektor { $a } in { $b }
core-the-points-lie-where-should-be = die Punkte liegen, wo { $a } sein sollte
core-these-samples-are-left-out-correct = diese Messpunkte werden weggelassen; berichtigen Sie ihren Reflektor oder messen Sie sie neu
core-the-instrument-was-locked-on-a = das Messgerät hing an einem Punkt fest, der sich nicht bewegt, in { $a }
core-the-measured-point-stays-while-the = der gemessene Punkt bleibt, während sich der Roboter bewegt
core-sample = Messpunkt { $a }
core-samples = Messpunkte { $a }
core-samples-and-more = Messpunkte { $a } und { $b } weitere
core-the-values-read-back-from-joint = die rückgelesenen Werte von Gelenk { $a } hängen dem Sollwert um { $b } nach
core-read-joint-back-at-standstill-taken = Gelenk { $a } im Stillstand rücklesen; so wie sie sind, sehen diese Werte nach Umkehrspiel oder Schleppfehler aus
core-reverse-joint = Gelenk { $a } umkehren
core-read-joint-as-degrees = Gelenk { $a } als Grad lesen
core-read-joint-as-radians = Gelenk { $a } als Radiant lesen
core-read-all-joints-as-degrees = Alle Gelenke als Grad lesen
core-read-all-joints-as-radians = Alle Gelenke als Radiant lesen
core-exchange-joints-and = Gelenke { $a } und { $b } vertauschen
core-subtract-joint-from-joint = Gelenk { $a } von Gelenk { $b } abziehen
core-add-joint-to-joint = Gelenk { $a } zu Gelenk { $b } addieren
core-start-from-the-values-read-back-2 = Von den rückgelesenen Werten ausgehen
core-turn-the-home-of-joint-by = Die Grundstellung von Gelenk { $a } um { $b } drehen
core-read-the-coordinates-as-metres = Die Koordinaten als Meter lesen
core-read-the-coordinates-as-inches = Die Koordinaten als Zoll lesen
core-read-the-coordinates-as-micrometres = Die Koordinaten als Mikrometer lesen
core-multiply-the-coordinates-by = Die Koordinaten mit { $a } multiplizieren
core-exchange-x-and-y = x und y vertauschen
core-read-x-y-z-from = x, y, z aus { $a } lesen
core-fit-the-measuring-frame = Das Messkoordinatensystem anpassen
core-remove = { $a } entfernen
core-remove-this-sample = Diesen Messpunkt entfernen
core-remove-these-samples = Diese { $a } Messpunkte entfernen
core-add-joint-in-the-value-of = Gelenk { $a } in den Wert von Gelenk { $b } einrechnen (addieren)
core-subtract-joint-in-the-value-of = Gelenk { $a } aus dem Wert von Gelenk { $b } herausrechnen (abziehen)

# The core: findings about a session

core-the-noise-of-the-instrument-is-not = das Rauschen des Messgeräts ist nicht angegeben: Es wird aus den Messpunkten geschätzt
core-measured = gemessen: { $a }
core-measured-with-the-table-of-model = mit der aktiven Tabelle des Modells { $a } gemessen: Die Messung zeigt, was bleibt, und nichts korrigiert sie ein zweites Mal
core-regions-and-overlap = die Regionen { $a } und { $b } überlappen sich
core-regions-that-touch-at-most-the = Regionen, die sich höchstens berühren; die zuerst genannte bekommt, was beide beanspruchen
core-two-regions-are-called = zwei Regionen heißen { $a }
core-a-name-of-its-own-for = für jede Region einen eigenen Namen
core-a-name-of-its-own-for-each = für jedes Gelenk einen eigenen Namen
core-regions-are-for-a-robot-with = Regionen gibt es für einen Roboter mit einem einzigen Drehgelenk: Sie werden nicht verwendet
core-targets-but-no-column-target-every = { $a } Reflektoren, aber keine Spalte target: Jeder Messpunkt gilt als { $b }
core-a-column-target = eine Spalte target
core-no-sample-shows-this-target = kein Messpunkt zeigt diesen Reflektor
core-no-sample-has-its-commanded-values = kein Messpunkt hat seine Sollwerte und etwas Gemessenes
core-at-least-one-complete-sample = mindestens ein vollständiger Messpunkt
core-of-samples-lack-a-commanded-value = { $a } von { $b } Messpunkten fehlt ein Sollwert oder alles Gemessene, sie sind nicht verwendbar: { $c }
core-of-samples-are-excluded-by-hand = { $a } von { $b } Messpunkten sind von Hand ausgeschlossen und zählen in keiner Zahl: { $c }
core-of-samples-lack-single-coordinates-the = { $a } von { $b } Messpunkten fehlen einzelne Koordinaten; die übrigen werden angepasst: { $c }
core-no-column-for-the-measured-z = keine Spalte für das gemessene z: Die Messung ist eben
core-every-sample-is-held-out-or = jeder Messpunkt ist zurückgehalten oder ausgeschlossen: Es bleibt nichts anzupassen
core-some-samples-marked-fit = einige Messpunkte mit der Kennzeichnung fit
core-measured-orientations-are-not-of-unit = { $a } gemessene Orientierungen haben nicht die Länge eins: { $b }
core-unit-quaternions = Einheitsquaternionen
core-samples-are-beyond-the-limits-of = { $a } Messpunkte liegen außerhalb der Grenzen von Gelenk { $b }: { $c }
core-commands-within-the-limits = Sollwerte innerhalb der Grenzen
core-negative-loads = negative Lasten: { $a }
core-0-kg-or-more = 0 kg oder mehr
core-temperatures-below-absolute-zero = Temperaturen unter dem absoluten Nullpunkt: { $a }
core-the-time-does-not-increase-at = die Zeit nimmt nicht zu bei { $a }; die Reihenfolge der Datei gilt als Messreihenfolge
core-setups-each-has-a-measuring-frame = { $a } Aufstellungen: Jede hat ihr eigenes Messkoordinatensystem
core-the-instrument-lost-the-reflector-0 = das Messgerät hat den Reflektor in { $a } Messpunkten verloren (0, 0, 0): { $b }
core-they-are-left-out = sie werden weggelassen

# The core: figures of the standards

core-samples-are-left-out-a-cell = { $a } Messpunkte sind weggelassen: Eine Zelle fehlt, der Reflektor ging verloren, oder sie sind von Hand ausgeschlossen
core-no-point-was-measured-xmm-ymm = es wurde kein Punkt gemessen (x_mm, y_mm): Die Zahlen beider Normen gelten für gemessene Positionen an befohlenen; Abstände, Richtungen, Aufnahmen und Antastungen allein ergeben keine
core-the-session-was-measured-with-a = gemessen wurde mit aktiver Tabelle: Die Zahlen gelten mit Kompensation, und nichts wird ein zweites Mal korrigiert
core-samples-were-taken-in-motion-the = Messpunkte wurden in Bewegung aufgenommen; die Normen messen im Stillstand, sodass Schleppfehler in diesen Zahlen steckt
core-poses-with-two-cycles-or-more = { $a } Posen mit zwei Zyklen oder mehr, { $b } aus mehreren Richtungen, { $c } Bahnen; von jeder Zahl die größte
core-no-pose-was-reached-twice-from = keine Pose wurde zweimal aus derselben Richtung nach einer anderen Pose erreicht
core-no-pose-was-repeated-from-several = keine Pose wurde aus mehreren Richtungen wiederholt
core-z-was-not-measured-figures-are = z wurde nicht gemessen: Die Zahlen gelten in der Ebene

# The core: import

core-decimal-point = Dezimalpunkt
core-decimal-comma = Dezimalkomma
core-the-unit-of-the-joint-values = die Einheit der Gelenkwerte ist nicht angegeben

# The core: units that were mistaken

core-the-values-of-joint = die Werte von Gelenk { $a } { $b }
core-the-values-of-all-joints = die Werte aller Gelenke { $a }
core-are-in-degrees-but-were-read = sind in Grad, wurden aber als Radiant gelesen
core-are-in-radians-but-were-read = sind in Radiant, wurden aber als Grad gelesen
core-the-measured-coordinates-are = die gemessenen Koordinaten sind { $a }
core-in-metres-but-were-read-as = in Metern, wurden aber als Millimeter gelesen
core-in-micrometres-or-were-multiplied-by = in Mikrometern oder wurden mit 1000 multipliziert
core-in-inches-but-were-read-as = in Zoll, wurden aber als Millimeter gelesen
core-in-millimetres-but-were-read-as = in Millimetern, wurden aber als Zoll gelesen
core-the-unit-of-x-y-z = die Einheit von x, y, z ist nicht angegeben: { $a }
core-the-points-spread-over-as-m = die Punkte erstrecken sich über { $a }: als m wären das { $b }, als mm { $c }, als in { $d }; { $e }
core-would-suit = { $a } würden passen, { $b }
core-as-robots-are-mostly-as-large = da Roboter meist so groß wie Menschen sind
core-beside-a-robot-that-reaches = neben einem Roboter mit { $a } Reichweite
core-positions-each-approached-from-below-and = { $a }; { $b } Positionen, jede angefahren: { $c } von unten und { $d } von oben
core-all-samples-alike = alle Messpunkte gleich
core-reflector = Reflektor { $a }
core-reflector-2 = Reflektor { $a }, { $b }
core-load-2 = Last { $a }
core-load-3 = Last { $a }, { $b }
core-measured-at = gemessen bei { $a }
core-measured-at-2 = gemessen bei { $a }, { $b }
core-setup = Aufstellung { $a }
core-setup-2 = Aufstellung { $a }, { $b }
core-other-joints-at = andere Gelenke bei { $a }
core-never = nie
core-once-or-more = einmal oder öfter
core-twice-or-more = zweimal oder öfter
core-times-or-more = { $a }-mal oder öfter
core-more-series-under-other-conditions-are = { $a } weitere Reihen unter anderen Bedingungen stehen in `standards --json`
core-of-positions-have-fewer-approaches-than = { $a } von { $b } Positionen wurden seltener angefahren als die anderen und sind weggelassen
core-not-every-position-was-approached-from = nicht jede Position wurde von { $a } angefahren: keine Zahl, die diese Seite braucht, und keine Umkehrspanne
core-a-position-was-approached-once-from = eine Position wurde nur einmal von { $a } angefahren: keine Standardabweichung, also keine Wiederholpräzision und keine Genauigkeit
core-below = unten
core-above = oben
core-approaches-from-each-side-the-standard = { $a } Anfahrten von jeder Seite; die Norm verlangt { $b }
core-positions-over-the-standard-asks-for = { $a } Positionen über { $b }; die Norm verlangt { $c }
core-paths-with-as-few-as-cycles = Bahnen mit nur { $a } Zyklen; die Norm verlangt { $b }
core-poses-with-as-few-as-cycles = Posen mit nur { $a } Zyklen; die Norm verlangt { $b }
core-no-pose-beside-the-paths-was = keine Pose neben den Bahnen wurde zweimal erreicht
core-the-side-from-which-a-joint = die Seite, von der ein Gelenk kam, ist nicht bekannt: Seine Richtungen gelten als eine
core-the-side-from-which-the-joint = die Seite, von der das Gelenk kam, ist nicht bekannt: Die Spalte { $a } fehlt
core-metres = Meter
core-millimetres = Millimeter
core-inches = Zoll
core-an-iso-2302-run-targets-and = ein Lauf nach ISO 230-2: Soll- und Istpositionen einer Achse
core-a-camera-that-sees-a-calibration = eine Kamera, die eine Kalibriertafel sieht: rvec und tvec jedes Bilds
core-a-tum-trajectory-time-position-quaternion = eine TUM-Trajektorie: Zeit, Position, Quaternion
core-any-program-a-table-with-a = jedes Programm: eine Tabelle mit Kopfzeile oder mit unten gewählten Spalten
core-an-mcap-recording-joint-states-and = eine MCAP-Aufzeichnung: Gelenkzustände und gemessene Posen
core-a-ballbar-a-drawwire-or-an = Ballbar, Seilzugsensor oder Interferometer: Abstände
core-a-laser-tracker-or-spatialanalyzer-names = ein Lasertracker oder SpatialAnalyzer: Namen, x, y, z

# The core: places in files

core-line-column = { $a }, Zeile { $b }, Spalte { $c }, { $d }
core-line-column-2 = { $a }, Zeile { $b }, Spalte { $c }
core-line = { $a }, Zeile { $b }
core-line-column-3 = Zeile { $a }, Spalte { $b }
core-line-2 = Zeile { $a }

# The core: exports

core-zeros-base-and-tool-frame = Nullpunkte, Basis und Werkzeug
core-mjcf-with-corrected-bodies = MJCF mit korrigierten Körpern
core-urdf-with-corrected-origins = URDF mit korrigierten Ursprüngen
core-kinematics-of-urdescription = Kinematik von ur_description
core-denavithartenberg-rows = Denavit-Hartenberg-Zeilen
core-lerobot-motor-calibration-and-urdf = LeRobot-Motorkalibrierung und URDF
core-c99-header-with-a-lookup-function = C99-Header mit Nachschlagefunktion
core-csv-table-with-json-metadata = CSV-Tabelle mit JSON-Metadaten
core-twincat-cnc-isg-list = TwinCAT-CNC-Liste (ISG)
core-twincat-nc-structured-text = Strukturierter Text für TwinCAT NC
core-the-numbers-are-the-corrected-geometry = die Zahlen sind die korrigierte Geometrie selbst: wo Gelenke und Werkzeug wirklich sind; zum Sollwert wird nichts addiert
core-this-robot-carries-it-is-from = dieser Roboter trägt { $a }; er liegt über den gemessenen Bereich { $b } vom Modell entfernt (höchstens { $c }), der nominelle { $d } (quadratisches Mittel)
core-zero-offsets-base-and-tool-frame = Nullpunkte, Basis und Werkzeug
core-zero-offsets-base-and-tool-frame-and = Nullpunkte, Basis und Werkzeug sowie die Armgeometrie
core-at-home-the-nominal-tool-is = in der Grundstellung ist das nominelle Werkzeug bei { $a }, dieser Roboter hat es bei { $b }
core-has-no-place-in-at-standstill = { $a } hat keinen Platz in { $b }: im Stillstand, ohne Last und bei 20 °C lässt es nichts übrig
core-has-no-place-in-it-leaves = { $a } hat keinen Platz in { $b }: Es lässt { $c } übrig
core-the-zero-offsets-are-in-this = die Nullpunktverschiebungen sind in dieser Datei: Lassen Sie die Nullpunkte der Steuerung, wie sie sind
core-no-joint-has-a-zero-offset = kein Gelenk hat eine Nullpunktverschiebung, die die Steuerung übernehmen müsste
core-the-zero-offsets-are-left-to = die Nullpunktverschiebungen bleiben der Steuerung und sind nicht in dieser Datei: Ihre Gelenke stehen jenseits der Anzeige, { $a }; verschieben Sie ihre Nullpunkte so, dass sie um so viel mehr anzeigt
core-the-zero-offsets-in-this-file = die Nullpunktverschiebungen in dieser Datei soll die Steuerung übernehmen: Sie muss um so viel mehr anzeigen, wie jedes Gelenk jenseits seines Sollwerts steht
core-base-where-the-robot-really-stands = base: wo der Roboter wirklich steht, im Basissystem; tool: das wirkliche Werkzeug im System des nominellen (neue Werkzeugdaten = jetzige mal dieses); zeros: wie weit jedes Gelenk jenseits seines Sollwerts steht
core-base-the-robots-base-in-the = base: die Basis des Roboters im Basissystem; tool: das wirkliche Werkzeug im System des nominellen
core-the-geometry-of-the-links-is = die Armgeometrie steckt nicht in diesen Zahlen; dh, urdf oder mjcf tragen sie
core-rows-cannot-say-where-the-first = Zeilen können nicht sagen, wo die erste Achse in der Basis steht: Geben Sie auch base ein
core-base-the-frame-before-the-first = base: das System vor der ersten Zeile im Basissystem; tool: das Werkzeug im System hinter der letzten Zeile
core-rows-in-the-convention = Zeilen nach der Konvention { $a }
core-base-the-frame-that-the-first = base: das System, in dem das erste Glied angegeben ist; tool: der TCP im System von wrist_3
core-set-the-tcp-to-with-the = setzen Sie den TCP auf { $a } mit dem Rotationsvektor { $b }: Das Werkzeug ist nicht Teil dieser Datei
core-for-the-launch-argument-kinematicsparamsfile-the = für das Startargument kinematics_params_file; der Treiber vergleicht dessen Hash mit der eigenen Kalibrierung der Steuerung und warnt, dass sie abweichen
core-masses-are-not-written-a-calibration = Massen werden nicht geschrieben: Eine Kalibrierung kennt die Trägheit eines Glieds nicht
core-names-that-are-empty-or-not = leere oder mehrfache Namen wurden geändert: Die Datei braucht für jedes einen
core-syntax-from-the-manual-not-tried = Syntax nach Handbuch, nicht an einer Steuerung erprobt
core-the-motors-show-more-than-before = die Motoren zeigen mehr an als vorher, in Schritten: { $a }; ihre Bereiche verschieben sich mit: Bleiben Sie den Anschlägen fern, bis Sie es erprobt haben
core-the-calibration-by-itself-with-the = die Kalibrierung allein, mit dem nominellen URDF, lässt { $a } über den gemessenen Bereich übrig (Stufe: Nullpunkte)
core-feetech-present-actual-homingoffset-a-joint = Feetech: present = actual − homing_offset; ein Gelenk jenseits seines Sollwerts bekommt ein kleineres homing_offset
core-dynamixel-present-actual-homingoffset-a-joint = Dynamixel: present = actual + homing_offset; ein Gelenk jenseits seines Sollwerts bekommt ein größeres homing_offset
core-the-calibration-by-itself-carries-the = die Kalibrierung trägt die Nullpunkte; das URDF daneben trägt den Rest und passt nur zu dieser Motorkalibrierung
core-the-zero-offsets-are-in-homingoffset = die Nullpunktverschiebungen stehen in homing_offset dieser Kalibrierung, in ganzen Schritten, und ihr Rest im URDF daneben: Nichts anderes soll sie übernehmen
core-the-zero-offsets-are-in-the = die Nullpunktverschiebungen stehen im URDF neben dieser Kalibrierung, die bleibt, wie sie war
core-no-calibration-was-given-the-homing = es wurde keine Kalibrierung angegeben: Die Homing-Offsets zählen ab 0, Nummern und Bereiche sind Platzhalter; geben Sie mit --reference die an, die beim Messen aktiv war
core-in-the-ini-file-the-joint = in der INI-Datei: { $a }; das Gelenk hat { $b }
core-backlash-is-ignored-while-compfile-is = BACKLASH wird ignoriert, solange COMP_FILE gesetzt ist: Die beiden Spalten tragen es
core-in-the-machine-data-md38000-mmenccompmaxpoints = in den Maschinendaten: MD38000 MM_ENC_COMP_MAX_POINTS mindestens { $a }, nach dem Laden { $b }; die Achse muss { $c } heißen
core-switched-on-after-referencing-the-axis = nach dem Referenzieren eingeschaltet, bewegt sich die Achse sofort um die Korrektur am Referenzpunkt, { $a } bei 0
core-the-808d-holds-points-for-it = die 808D fasst { $a } Punkte; geben Sie für sie eine größere Schrittweite an
core-ismodulo-1-is-for-a-modulo = IS_MODULO = 1 gilt für eine Moduloachse; für eine begrenzte auf 0 setzen
core-modulo-1-is-for-a-modulo = modulo 1 gilt für eine Moduloachse; für eine begrenzte auf 0 setzen
core-in-the-axis-list-have-to = in der Achsliste: { $a }; { $b } müssen die der Achse sein; keine andere Losekompensation daneben
core-the-largest-value-needs-a-build = der größte Wert, { $a }, braucht eine Version mit 32-Bit-Werten; ältere haben 16
core-in-the-plc-the-axis-counts = in der SPS: { $a }; die Achse zählt in { $b }
core-no-joint-removes-root-mean-square = kein Gelenk beseitigt { $a } (quadratisches Mittel über den gemessenen Bereich)

# The core: poses to measure next

core-makes-and-more-testable = macht { $a } und { $b } weitere prüfbar: { $c }
core-makes-testable = macht { $a } prüfbar: { $b }
core-what-the-others-are-compared-with = womit die anderen verglichen werden
core-tells-they-differ-most-at = unterscheidet { $a }: Sie weichen am meisten ab bei { $b }
core-not-determined = nicht bestimmt
core-implausibly-large-more-than-ten-times = unplausibel groß: mehr als das Zehnfache des Üblichen
core-not-determined-by-these-samples = { $a }: durch diese Messpunkte nicht bestimmt
core-any-size-there-is-no-noise = { $a }: jede Größe, es gibt kein Rauschen
core-not-observable-with-these-poses = { $a }: mit diesen Posen nicht beobachtbar
core-pose = Pose
core-from = von
core-reflector-3 = Reflektor
core-conditions = Bedingungen
core-second-time = zum zweiten Mal
core-is-a-new-reflector-mount-it = { $a } ist ein neuer Reflektor: bei { $b } im Werkzeugsystem anbringen und einmessen, wo er wirklich ist
core-with = mit
core-joint-2 = Gelenk { $a } ({ $b })
core-poses = Posen

# The core: what of a program is not corrected

core-its-position-is-singular-a-small = seine Position ist singulär: Eine kleine Korrektur bräuchte eine große Bewegung der Gelenke
core-the-real-tool-does-not-reach = das wirkliche Werkzeug erreicht es nicht: { $a } bleiben
core-its-correction-would-lead-into-another = seine Korrektur führte in eine andere Konfiguration
core-with-its-correction = { $a } mit seiner Korrektur
core-no-joint-values-within-the-limits = keine Gelenkwerte innerhalb der Grenzen erreichen es
core-endlessly-many-joint-values-reach-it = unendlich viele Gelenkwerte erreichen es, und kein Zielpunkt davor sagt, welche
core-no-joint-values-near-those-of = keine Gelenkwerte nahe denen des vorigen Zielpunkts erreichen es
core-joint-values-reach-it-but-none = Gelenkwerte erreichen es, aber keine mit seiner Konfiguration
core-several-joint-values-reach-it-and = mehrere Gelenkwerte erreichen es, und kein Zielpunkt davor sagt, welche
core-two-sets-of-joint-values-reach = zwei Sätze von Gelenkwerten erreichen es, die dem vorigen Zielpunkt gleich nahe sind
core-no-joint-values-reach-it = keine Gelenkwerte erreichen es
core-it-is-singular-lines-of-joint = es ist singulär: Linien von Gelenkwerten erreichen es
core-joint-would-be-at-beyond-its = Gelenk { $a } wäre bei { $b }, jenseits seiner Grenze von { $c }
core-its-orientation-is-none = seine Orientierung ist keine
core-goes-to-which-is-worked-out = { $a } fährt zu { $b }, was erst zur Laufzeit berechnet wird
core-is-worked-out-at-run-time = { $a } wird erst zur Laufzeit berechnet
core-is-changed-at-run-time = { $a } wird zur Laufzeit geändert
core-is-chosen-at-run-time = { $a } wird zur Laufzeit gewählt
core-is-not-written-out-in-numbers = { $a } ist nicht in Zahlen ausgeschrieben
core-is-declared-elsewhere = { $a } ist anderswo deklariert
core-is-declared-several-times = { $a } ist mehrfach deklariert
core-has-its-numbers-elsewhere = { $a } hat seine Zahlen anderswo
core-has-no-value-in-this-file = { $a } hat keinen Wert in dieser Datei
core-shifts-the-poses-after-it = { $a } verschiebt die Posen danach
core-moves-by-a-way-from-where = { $a } bewegt um einen Weg von dort, wo der Roboter steht
core-its-frame-is-not-known = sein Koordinatensystem ist nicht bekannt: { $a }
core-its-tool-is-not-known = sein Werkzeug ist nicht bekannt: { $a }
core-its-tool-is-declared-elsewhere = sein Werkzeug { $a } ist anderswo deklariert
core-which-tool-it-is-of-is = es ist nicht gesagt, zu welchem Werkzeug es gehört
core-is-gone-to-from-several-sides = { $a } wird von mehreren Seiten angefahren; Effekte der Seite bleiben außer Acht
core-is-used-here-as-well-with = { $a } wird auch hier verwendet, mit seinen korrigierten Werten
core-is-a-pose-that-no-move = { $a } ist eine Pose, zu der keine Bewegung dieser Datei führt
core-is-not-corrected = { $a } wird nicht korrigiert: { $b }
core-another-routine-of-this-file-sets = eine andere Routine dieser Datei setzt es
core-it-is-set-in-a-branch = es wird in einer Verzweigung oder Schleife gesetzt

# The core: held out by joint

core-each-fifth-of-the-positions-of = jedes Fünftel der Positionen von Gelenk { $a } (über seinen Bereich verteilt) vorhergesagt von einer Anpassung, die es nicht gesehen hat
core-no-two-positions-of-the-joint = keine zwei Positionen des Gelenks wurden bei sonst Gleichem (andere Gelenke, Reflektor, Last, Geschwindigkeit) und mit einem Reflektor abseits der Achse gemessen
core-semicolons = Semikolons
core-commas = Kommas
core-tabs = Tabulatoren
core-spaces = Leerzeichen

# The core: steps of the gap chart

core-nominal-robot = Sollroboter
core-zero-offset-and-link-length = Nullpunkt und Armlänge
core-geometry-frame-zero-offsets-links-and = Geometrie: Koordinatensystem, Nullpunkte, Arme und Werkzeug
core-full-model = volles Modell

# The core: problems of a file

core-expected = { $a }: { $b }; erwartet: { $c }
core-the-end-of-the-document = das Ende des Dokuments
core-the-end-of-the-file = das Ende der Datei
core-a-key-in-double-quotes = ein Schlüssel in doppelten Anführungszeichen
core-the-key-a-second-time = der Schlüssel { $a } ein zweites Mal
core-every-key-once = jeder Schlüssel einmal
core-after-the-key = ':' nach dem Schlüssel
core-or = ',' oder ']'
core-a-text = ein Text
core-an-object = ein Objekt
core-an-array = ein Array
core-an-array-of-objects = ein Array von Objekten
core-an-array-of-numbers = ein Array von Zahlen
core-an-array-of-numbers-null-where = ein Array von Zahlen (null, wo eine fehlt)
core-an-array-of-texts-null-where = ein Array von Texten (null, wo einer fehlt)
core-an-array-with-an-object-for = ein Array mit einem Objekt für jedes Gelenk
core-an-array-with-a-frame-for = ein Array mit einem Koordinatensystem für jedes Gelenk
core-an-array-of-regions = ein Array von Regionen
core-an-array-of-names-of-stations = ein Array von Namen von Standorten
core-an-array-of-numbers-2 = ein Array von { $a } Zahlen
core-an-array-of-numbers-3 = ein Array von { $a } Zahlen: { $b }
core-the-position-in-the-tool-frame = die Position im Werkzeugkoordinatensystem, mm
core-the-position-in-the-measuring-frame = die Position im Messkoordinatensystem, mm; oder null
core-the-centre-at-home-in-the = der Mittelpunkt in Grundstellung, im Basiskoordinatensystem
core-a-direction-that-is-not-zero = eine Richtung, die nicht null ist
core-where-the-tracker-stands-mm = wo der Tracker steht, mm
core-an-object-with = ein Objekt mit { $a }
core-an-object-with-and = ein Objekt mit { $a } und { $b }
core-an-object-with-and-2 = ein Objekt mit { $a }, { $b } und { $c }
core-an-object-with-or-null = ein Objekt mit { $a }, oder null
core-an-object-with-and-or-null = ein Objekt mit { $a } und { $b }, oder null
core-an-object-with-a-number-for = ein Objekt mit einer Zahl für jeden Parameter
core-an-object-with-a-position-for = ein Objekt mit einer Position für jeden Namen
core-an-object-with-an-array-for = ein Objekt mit einem Array für jede Spalte
core-an-object-with-an-entry-for = ein Objekt mit einem Eintrag für jeden Namen
core-an-object-that-describes-the-robot = ein Objekt, das den Roboter beschreibt
core-an-object-that-describes-a-region = ein Objekt, das eine Region beschreibt
core-an-object-that-describes-a-joint = ein Objekt, das ein Gelenk beschreibt
core-a-number-above-0 = eine Zahl über 0
core-a-number-above-0-or-null = eine Zahl über 0, oder null
core-a-positive-number-or-an-array = eine positive Zahl, oder ein Array von 3 positiven Zahlen
core-a-range-from-the-smaller-to = ein Bereich vom kleineren zum größeren Wert
core-a-region-from-the-smaller-to = eine Region vom kleineren zum größeren Wert
core-an-empty-array = ein leeres Array
core-a-robot-without-joints = ein Roboter ohne Gelenke
core-a-direction-of-zero-length = eine Richtung der Länge null
core-a-quaternion-of-zero-length = eine Quaternion der Länge null
core-an-axis-of-zero-length = eine Achse der Länge null
core-a-direction-such-as = eine Richtung wie { $a }
core-a-quaternion-such-as = eine Quaternion wie { $a }
core-a-number-that-a-double-can = eine Zahl, die ein Double fasst (unter 1.8e308)
core-a-number-that-overflows = eine Zahl, die überläuft
core-an-array-with-a-number-that = ein Array mit einer Zahl, die überläuft
core-an-array-with-null-in-it = ein Array mit null darin
core-one-finite-number = eine endliche Zahl
core-a-length-above-0-mm = eine Länge über 0 mm
core-a-length-above-0-mm-or = eine Länge über 0 mm, oder null
core-a-mass-of-0-kg-or = eine Masse von 0 kg oder mehr
core-a-joint-counted-from-1 = ein Gelenk, ab 1 gezählt
core-a-name-that-truepose-effects-lists = ein Name, den `truepose effects` nennt
core-one-of-joints-with-tool-dh = eines von joints (mit tool), dh, urdf oder mjcf
core-not-a-regular-file = keine gewöhnliche Datei
core-a-file-that-grows = eine Datei, die wächst
core-a-document-with-a-key-format = ein Dokument mit dem Schlüssel format
core-a-json-value = ein JSON-Wert
core-a-text-that-never-ends = ein Text, der nie endet
core-a-control-character-in-a-text = ein Steuerzeichen in einem Text
core-regions-of-another-robot-than-one = Regionen eines anderen Roboters als eines mit einem einzigen Drehgelenk
core-no-regions-for-this-robot = keine Regionen für diesen Roboter
core-rows-that-a-robot-can-be = Zeilen, aus denen ein Roboter gebildet werden kann
core-a-station-of-the-session = ein Standort der Messung
core-an-include-that-leads-elsewhere = ein Include, das woandershin führt
core-a-link-that-leaves-the-folder = eine Verknüpfung, die den Ordner verlässt
core-a-json-number-such-as-125 = eine JSON-Zahl wie -12.5 oder 3e-4
core-key-is-not-known-ignored = der Schlüssel { $a } ist nicht bekannt: nicht beachtet
core-no-key = kein Schlüssel { $a }
core-a-number = eine Zahl
core-a-name-without-spaces-around-it = ein Name ohne Leerzeichen davor und dahinter
core-no-sample = kein Messpunkt
core-at-least-one = mindestens einer
core-more-cells-like-these-from-here = { $a } weitere Zellen dieser Art von hier an
core-1-1-or-0-unknown = 1, -1 oder 0 (unbekannt)
core-a-target-of-the-session = ein Reflektor der Messung: { $a }
core-an-empty-cell-while-there-are = eine leere Zelle, obwohl es mehrere Reflektoren gibt
core-target-is-not-declared = der Reflektor { $a } ist nicht deklariert
core-fit-heldout-or-excluded = fit, held-out oder excluded
core-a-column-for-each-quantity = eine Spalte für jede Größe
core-one-column-for-each-quantity-remove = eine Spalte für jede Größe: eine der beiden entfernen
core-column-is-not-known-kept-and = die Spalte { $a } ist nicht bekannt: behalten und nicht beachtet
core-joint-does-not-exist = Gelenk { $a } gibt es nicht
core-a-joint-of-the-robot-from = ein Gelenk des Roboters, von 1 bis { $a }
core-a-length = eine Länge
core-an-angle = ein Winkel
core-no-column-for-the-commanded-value = keine Spalte für den Sollwert von Gelenk { $a }
core-no-column-for-the-measured = keine Spalte für gemessenes { $a }
core-one-of-the-two-columns-of = eine der beiden Spalten einer gemessenen Richtung
core-both-azimuthdeg-and-elevationdeg-or-none = azimuth_deg und elevation_deg oder keine
core-all-of-qw-qx-qy-qz = alle von qw, qx, qy, qz oder keine
core-a-line-of-headings = eine Zeile mit Überschriften
core-an-empty-file = eine leere Datei
core-a-line-of-headings-and-one = eine Zeile mit Überschriften und eine Zeile je Messpunkt
core-a-binary-file-it-holds-nul = eine Binärdatei (sie enthält NUL-Bytes)
core-a-csv-file-headings-and-one = eine CSV-Datei: Überschriften und eine Zeile je Messpunkt
core-numbers-in-the-first-line = Zahlen in der ersten Zeile: { $a }
core-a-file-in-utf16 = eine Datei in UTF-16
core-utf8-text-truepose-import-file-as = Text in UTF-8; `truepose import FILE --as csv` liest UTF-16
core-bytes-that-are-not-utf8 = Bytes, die nicht UTF-8 sind
core-a-json-document-in-utf8 = ein JSON-Dokument in UTF-8
core-the-line-ends-after = die Zeile endet nach { $a }
core-one-for-each-heading = { $a }, eine je Überschrift
core-more-problems-of-this-kind = { $a } weitere Probleme dieser Art
core-a-directory = ein Verzeichnis
core-a-device-or-a-pipe = ein Gerät oder eine Pipe
core-no-such-folder = diesen Ordner gibt es nicht
core-a-file = eine Datei
core-a-folder = ein Ordner
core-a-file-that-can-be-read-to-its-end = eine bis zum Ende lesbare Datei
core-a-regular-file = eine gewöhnliche Datei
core-no-such-file = diese Datei gibt es nicht
core-no-permission-to-read-it = kein Recht, sie zu lesen
core-a-file-that-can-be-read = eine lesbare Datei
core-a-path-that-leads-upwards = ein Pfad, der nach oben führt
core-an-absolute-path = ein absoluter Pfad
core-a-quote-that-nothing-closes = ein Anführungszeichen, das nichts schließt
core-a-second-quote-or-none = ein zweites Anführungszeichen oder keines
core-no-table-no-line-of-cells = keine Tabelle: keine Zeile von Zellen, deren eine eine Zahl ist
core-rows-of-cells-between-tabs-semicolons = Zeilen von Zellen zwischen Tabulatoren, Semikolons, Kommas oder Leerzeichen
core-more-cells-or-rows-like-these = { $a } weitere Zellen oder Zeilen dieser Art
core-no-row-that-can-be-read = keine lesbare Zeile
core-a-number-with-a-decimal-point = eine Zahl mit Dezimalpunkt
core-a-number-with-a-decimal-comma = eine Zahl mit Dezimalkomma
core-a-finite-number-or-an-empty = eine endliche Zahl, oder eine leere Zelle, wo sie fehlt
core-a-time-seconds-or-1234567 = eine Zeit: Sekunden oder 12:34:56.7
core-no-measurement-falls-into-the-time = keine Messung fällt in die Zeit der Sollwerte
core-no-measurement-falls-into-a-stop = keine Messung fällt in einen Halt der Sollwerte
core-of-measurements-were-taken-at-stops = { $a } von { $b } Messungen wurden im Halt aufgenommen: alle werden behalten, mit ihren Geschwindigkeiten
core-left-out-of-measurements-taken-before = { $a } von { $b } Messungen weggelassen, vor dem ersten oder nach dem letzten Sollwert aufgenommen: { $c }
core-exists-already-force-replaces-it = { $a }: gibt es schon; --force ersetzt sie
core-cancelled-2 = { $a }: abgebrochen
core-a-pointing-run-for-tpoint-where = Pointing-Lauf für TPOINT: wo die Montierung stand und wo der Stern war
core-angles-of-the-orientation = Winkel der Orientierung
core-socket = Pfanne
core-plane = Ebene
core-distances-between-sockets = Abstände zwischen Pfannen
core-axis-of-the-tool-that-points = Werkzeugachse, die zeigt
core-columns-that-may-be-what-was = Spalten, die das Gemessene sein können: { $a }
core-the-unit-of-the-angles-is = die Einheit der Winkel ist nicht angegeben
core-the-orientation-is-there-as-a = die Orientierung ist als Quaternion und als Winkel da
core-three-angles-of-an-orientation-and = drei Winkel einer Orientierung; weder die Reihenfolge der Achsen noch, ob sie sich mitdrehen, ist angegeben
core-the-angles-turn-in-the-order = die Winkel drehen in der Reihenfolge { $a }; ob um feste Achsen (des Messsystems) oder um mitgedrehte, ist nicht angegeben
core-lists-read-as-a-table-of = Listen, gelesen als Tabelle mit { $a } Zeilen und { $b } Spalten
core-no-header-the-columns-are-taken = keine Kopfzeile: Die Spalten gelten als { $a }
core-target = Messpunkt { $a }
core-fit-the-places-of-the-targets = Orte der Messpunkte mitschätzen
core-target-is-elsewhere-from-its-stated = Messpunkt { $a } ist woanders: { $b } von seinem angegebenen Ort am Werkzeug
core-its-place-is-fitted-moved-by = sein Ort wird mitgeschätzt (verschoben um { $a }, { $b }, { $c } mm); nachmessen oder targets_sigma_mm angeben
core-the-base-model-leaves-as-it = das Grundmodell lässt { $a } wie angegeben und { $b } mit freiem Ort übrig; { $c }-mal wahrscheinlicher
core-the-socket-that-the-target-sat = die Aufnahme, in der der Messpunkt in allen Zeilen saß, wo keine Spalte sie nennt: Gelenkwerte genügen dann
core-the-plane-that-was-touched-in = die Ebene, die in allen Zeilen angetastet wurde, wo keine Spalte sie nennt: Gelenkwerte genügen dann
core-known-distances-between-sockets-mm-such = bekannte Abstände zwischen Aufnahmen, mm, etwa S1-S2=400: einer davon legt die Größe des Roboters fest
core-how-rx-ry-rz-or-euler1 = wie rx, ry, rz (oder euler1, euler2, euler3) eine Orientierung ergeben: eine Folge von Achsen und ob sie sich mitdrehen, etwa zyx-moving, xyz-fixed (= zyx-moving) oder zyz-moving; rpy (= xyz-fixed); rotvec
core-its-position-is-nearly-singular-the = seine Position ist fast singulär: Die Korrektur würde das Werkzeug um { $a } drehen
core-the-search-was-stopped-this-is = Die Suche wurde angehalten: das ist, was bis dahin belegt war
core-the-search-was-stopped-this-is-2 = Die Suche wurde angehalten: das ist, was bis dahin belegt war; { $a }
core-the-search-stopped-at-its-budget = Die Suche endete an ihrem Budget: das ist, was bis dahin belegt war
core-the-search-stopped-at-its-budget-2 = Die Suche endete an ihrem Budget: das ist, was bis dahin belegt war; { $a }
core-a-smooth-curve-over-joint-explains = eine glatte Kurve über Gelenk { $a } erklärt so viel wie { $b } zusammen
core-the-remaining-error-is-times-the = der verbleibende Fehler ist das { $a }-fache der Rauschgrenze ({ $b } mm): das Messkoordinatensystem wandert, oder etwas ändert sich ebenso langsam
core-on-the-session-that-it-came = auf der Messung, aus der es stammt, lässt das Modell einen RMS-Fehler von { $a } mm, gesagt waren { $b } mm: es wird nicht geschrieben
core-on-the-session-that-it-came-2 = auf der Messung, aus der es stammt, lässt das Modell einen RMS-Fehler von { $a } mm, der nominale Roboter { $b } mm: es wird nicht geschrieben
core-the-model-leaves-an-rms-error = das Modell lässt einen RMS-Fehler von { $a } mm, die Identifikation, mit der es begann, { $b } mm: es wird nicht geschrieben
core-the-model-predicts-no-position-at = das Modell sagt bei den Gelenkwerten { $a } (rad, mm) keine Position voraus: es wird nicht geschrieben
core-with-this-the-rms-error-of = mit dieser Ausgabe ({ $a }) stiege der RMS-Fehler von „{ $b }“ von { $c } auf { $d } mm: es wird nichts geschrieben
core-description-of-the-robot = Beschreibung des Roboters

robots-robots = Roboter
robots-robots-2 = Roboter…
robots-type-a-maker = { $count } verbreitete Roboter mit ihrer nominellen Geometrie: Hersteller, Modell oder Bauart eingeben
robots-hint = etwa ur5e, kuka kr 6, scara
robots-find-a-robot = Roboter suchen
robots-no-robot-has-this-name = Kein Roboter heißt so
robots-at-its-zero = { $robot } in Nullstellung
robots-kind = Bauart
robots-reach = Reichweite, Traglast
robots-repeatability = Wiederholgenauigkeit (ISO 9283)
robots-source = Geometrie aus
robots-not-checked = Nicht gegen eine zweite Quelle geprüft: { $what }
robots-six-joints = sechs Gelenke
robots-six-joints-offset-wrist = sechs Gelenke, versetztes Handgelenk
robots-seven-joints = sieben Gelenke
robots-positioner = Positionierer
robots-rotary-axis = Drehachse
robots-save-robot-file = Roboterdatei speichern…
robots-save-robot-file-2 = Roboterdatei speichern
robots-robot-json = Roboter (*.json)
robots-a-file-for-sessions = Eine Datei, die Messungen, Importe und Pläne annehmen
robots-simulate = Simulieren…
keys-robots = Roboter der Bibliothek
simulation-poses = Posen
simulation-joint = Gelenk
simulation-poses-from-one = 1 bis { $most } Posen
simulation-a-robot-of-the-library = Posen überall in den Gelenkbereichen, drei Reflektoren am Werkzeug, Geschwindigkeiten, Lasten und eine Erwärmung darüber gemischt. Was hier eingetragen ist, soll die Diagnose finden
hidden-show = Zeigen, was verborgen war
hidden-hide = Nicht zeigen, was verborgen war
hidden-hidden = In dieser Simulation verborgen
hidden-nothing = Nichts
hidden-found = gefunden
hidden-identified = identifiziert
hidden-not-found = nicht gefunden
