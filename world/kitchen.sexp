; What the furniture of the kitchen is for: where things are, and where they belong.
; Units: m, degrees. Names of links and joints are those in world/kitchen.urdf. A description of another
; kitchen may also have (alias NAME LINK-OR-JOINT): a name by which users call it.

; What plans call it, and what its URDF is called by programs that ask for it. The usual joint is the
; one that move-kitchen-joint moves if none is named.
(kitchen kitchen :urdf-name iai_kitchen :usual-joint iai_fridge_door_joint)

; Places by name: the keys are those of location designators. The place called table is where the
; table is set. CRAM's newer kitchen has a dining table, shelves in the door of the fridge and a tray
; in the dishwasher; here the island is the table, the milk stands on the bottom of the fridge, and
; dishes come into a drawer.
(place table :on kitchen_island_surface)
(place setting :on kitchen_island_surface :side (back right))
(place setting-of-bowl
       :on kitchen_island_surface :side (back right) :context table-setting :object-count 2)
(place setting-of-bowl-from-counter
       :on kitchen_island_surface :side (back right) :range-invert 0.5
       :context table-setting :object-count 3)

; The counter with the sink: things that are needed on the table stand at its back, plates at its right.
(place back-of-sink-counter :on sink_area_surface :side (right back) :range 0.5)
(place right-of-sink-counter :on sink_area_surface :side (right back) :range-invert 0.5)
(place sink :on sink_area_sink :side left)

; The back of a drawer is in front when it is open. On the bottom of the fridge there is room in front.
(place cutlery-drawer :in sink_area_left_upper_drawer_main :side back)
(place bowl-drawer :in sink_area_left_middle_drawer_main :side back)
(place cup-drawer :in kitchen_island_left_upper_drawer_main :side back)
(place fridge :in iai_fridge_main :side back)

; The top board of the tall drawer beside the oven.
(place top-board
       :in oven_area_area_right_drawer_main :level topmost :orientation support-aligned)

; Where things of a type usually are, by what they are needed for: on the sink counter in the context
; table-setting-counter, in drawers and the fridge in table-setting, on the set table in
; table-cleaning. Of several records with a type, the first counts.
(usually cutlery-drawer
         :contexts (table-setting-counter table-setting) :types (spoon knife fork cutlery))
(usually bowl-drawer :contexts (table-setting) :types (bowl))
(usually cup-drawer :contexts (table-setting) :types (cup))
(usually fridge :contexts (table-setting) :types (milk))
(usually top-board :contexts (table-setting) :types (cereal breakfast-cereal))
(usually right-of-sink-counter :contexts (table-setting-counter) :types (plate))
(usually back-of-sink-counter
         :contexts (table-setting-counter)
         :types (bowl bottle mug milk cereal breakfast-cereal cup))
(usually table
         :contexts (table-cleaning)
         :types (plate bowl bottle mug milk cereal breakfast-cereal cup spoon knife fork cutlery))

; Where things belong; without :types, all for which no record has their type. In the first two contexts,
; cups, milk and cutlery are put beside the bowl on the table unless a record has their type. What CRAM puts onto the tray of the dishwasher comes into a
; drawer, since there is no tray; what it drops into the drawer for waste is kept in the fridge, since
; no hand gets down to the bottom of that drawer with a carton.
(belongs setting-of-bowl-from-counter :contexts (table-setting-counter) :types (bowl))
(belongs setting-of-bowl :contexts (table-setting) :types (bowl))
(belongs setting :contexts (table-setting-counter table-setting))
(belongs bowl-drawer :contexts (table-cleaning) :types (bowl cup spoon))
(belongs fridge :contexts (table-cleaning) :types (milk bottle))
(belongs top-board :contexts (table-cleaning) :types (cereal breakfast-cereal))
(belongs sink :contexts (table-cleaning) :types (plate mug knife fork cutlery))

; Where things are before the household demo, in the order in which the table is set: the bowl, and
; then what has the least room beside it. CRAM brings the spoon last; here the place that is left for
; it is often blocked then, by the cup or by the cereal. Position and heading are in the frame of the
; link.
(store bowl :in sink_area_left_middle_drawer_main :position (0.10 -0.0505 -0.062) :heading 0)
(store spoon :in sink_area_left_upper_drawer_main :position (0.125 0 -0.0136) :heading 0)
(store cup :in kitchen_island_left_upper_drawer_main :position (0.11 0.08 -0.026) :heading 0)
(store milk :in iai_fridge_main :position (0.0 0.0 -0.07) :heading 0)
(store breakfast-cereal
       :in oven_area_area_right_drawer_main :position (0.10 -0.03 0.46) :heading 90)

; What of a surface a set table leaves free: at the ends of x, the lower one first, then at those of y.
; Elsewhere it is 0.03.
(surface kitchen_island_surface :margins (0.1 0.1 0.1 0.8))

; Views of furniture: the point in the middle of the picture in the frame of the link; of the eye, x
; and y from that point along the axes of the map, and its height above the floor.
(view table :link table_area_main :at (0 0 0.75) :eye (-1.75 -1.9 1.75))
(view island :link kitchen_island_surface :at (0.2 0.2 0.05) :eye (-2.0 -1.7 2.0))
