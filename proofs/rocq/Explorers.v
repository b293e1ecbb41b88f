(** Robots that explore cells, as the kernel's do: each has its own map, goes to the rim of its cell, looks, and arrives,
    and tells the others, who may miss it. For every number of robots, every finite graph of cells, every set of
    obstacles, every order and whatever is missed: FRONTIER-1, FRONTIER-4 and FRONTIER-5, by the plain rule and by the
    repaired one. *)
From Coq Require Import Lia Bool List Arith.
From Tautline Require Import Frontier.
Import ListNotations.

(** A robot stands; is at the rim of its cell and looks into another one; or moves into that one. *)
Inductive stance (V : Type) := Stands | Tries (v : V) | Enters (v : V).
Arguments Stands {V}. Arguments Tries {V} v. Arguments Enters {V} v.

(** A robot: its map, where it is, which cell it has claimed, whether it waits for its slot, whether its map has grown since
    it looked last, and where the others have said that they are and what they have claimed. *)
Record robot (V : Type) := { explored : list V; blocked : list V; place : V; doing : stance V; aim : option V;
  waits : bool; news : bool; told : nat -> V * option V }.
Arguments explored {V} r. Arguments blocked {V} r. Arguments place {V} r. Arguments doing {V} r. Arguments aim {V} r.
Arguments waits {V} r. Arguments news {V} r. Arguments told {V} r.

(** A rule says to which cells a robot may go next, each with the unknown cell that it has claimed then, whether claims
    are told, and whether a robot turns back at the rim of a cell that it has claimed and that its map has for explored by
    then. *)
Record rule (V : Type) := { chooses : nat -> robot V -> list (V * V); claims : bool; returns : bool }.
Arguments chooses {V} r. Arguments claims {V} r. Arguments returns {V} r.

(** What may happen, with the robots that miss what is said. Of a look into a cell with a robot also those which the
    looking one does not hear, and the slot that it is when the first one begins to wait. *)
Inductive event (V : Type) :=
| Decides (i : nat) (v c : V) (missed : list nat)
| Looks (i : nat) (missed unheard : list nat) (slot : nat)
| Arrives (i : nat) (missed : list nat)
| Ticks.
Arguments Decides {V} i v c missed. Arguments Looks {V} i missed unheard slot. Arguments Arrives {V} i missed.
Arguments Ticks {V}.

(** The robots, the cells in which one was, whose slot it is, who was under way when it began, and whether its robot has
    met another one in it. *)
Record world (V : Type) := { robots : nat -> robot V; been : list V; slot : nat; old : list nat; tried : bool }.
Arguments robots {V} w. Arguments been {V} w. Arguments slot {V} w. Arguments old {V} w. Arguments tried {V} w.

(** [&&&] and [|||] look at what is behind them only if they must. *)
Local Open Scope lazy_bool_scope.
Lemma lazy_and : forall a b : bool, (a &&& b) = a && b. Proof. reflexivity. Qed.
Lemma lazy_or : forall a b : bool, (a ||| b) = a || b. Proof. reflexivity. Qed.

Section Area.
  Variables (V : Type) (same : V -> V -> bool) (cells : list V) (beside : V -> list V) (obstacle : V -> bool).
  Variable N : nat.

  Definition has (l : list V) (v : V) : bool := existsb (same v) l.
  Definition is_in (i : nat) (l : list nat) : bool := existsb (Nat.eqb i) l.
  Definition join (l m : list V) : list V := l ++ filter (fun v => negb (has l v)) m.
  Definition grows_by (l m : list V) : bool := negb (forallb (has l) m).
  Definition some (f : nat -> bool) : bool := existsb f (seq 0 N).
  Definition put {A : Type} (f : nat -> A) (i : nat) (x : A) : nat -> A := fun j => if j =? i then x else f j.

  (** ** Who acts. *)
  Section Rule.
    Variable rl : rule V.

    (** It knows a way to an unknown cell. *)
    Definition would (w : world V) (i : nat) : bool := match chooses rl i (robots w i) with [] => false | _ => true end.
    Definition moves (w : world V) (i : nat) : bool := match doing (robots w i) with Stands => false | _ => true end.
    Definition waiting (w : world V) (i : nat) : bool := waits (robots w i) && would w i.
    Definition may_decide (w : world V) (i : nat) : bool :=
      negb (moves w i) && would w i && (negb (waits (robots w i)) || ((slot w =? i) && negb (tried w))).
    (** A slot is over when its robot has tried, if it waits, and neither it nor who was under way when the slot began
        is under way. *)
    Definition may_tick (w : world V) : bool :=
      some (waiting w) && negb (waiting w (slot w) && negb (tried w))
      && negb (some (fun i => moves w i && (is_in i (old w) || (i =? slot w)))).

    (** Robots other than [i] that are in [v], on their way into it, or at its rim. *)
    Definition meets (w : world V) (i : nat) (v : V) : list nat :=
      filter (fun j => negb (j =? i) && (same (place (robots w j)) v
        || match doing (robots w j) with Stands => false | Tries x | Enters x => same x v end)) (seq 0 N).

    (** ** What comes of it. *)
    Definition hears (r : robot V) (from : nat) (said : robot V) : robot V :=
      {| explored := join (explored r) (explored said); blocked := join (blocked r) (blocked said);
         place := place r; doing := doing r; aim := aim r; waits := waits r;
         news := news r || grows_by (explored r) (explored said) || grows_by (blocked r) (blocked said);
         told := put (told r) from (place said, aim said) |}.
    (** [i] tells all but those that miss it. *)
    Definition tells (f : nat -> robot V) (i : nat) (missed : list nat) : nat -> robot V :=
      let said := f i in fun j => if (j =? i) || is_in j missed then f j else hears (f j) i said.
    Definition is_told (f : nat -> robot V) (i : nat) (by_ : list nat) : nat -> robot V :=
      put f i (fold_left (fun r j => hears r j (f j)) by_ (f i)).

    (** Who has looked has no news any more. *)
    Definition becomes (r : robot V) (d : stance V) (a : option V) (wait : bool) : robot V :=
      {| explored := explored r; blocked := blocked r; place := place r; doing := d; aim := a; waits := wait;
         news := match d with Tries _ => news r | Stands | Enters _ => false end; told := told r |}.
    Definition blocks (r : robot V) (v : V) : robot V :=
      {| explored := explored r; blocked := join (blocked r) [v]; place := place r; doing := Stands; aim := None;
         waits := false; news := grows_by (blocked r) [v]; told := told r |}.
    (** Another robot has been in the cell that it is about to enter. *)
    Definition late (r : robot V) (v : V) : bool :=
      returns rl && has (explored r) v && match aim r with Some a => same a v | None => false end.
    Definition turns (r : robot V) : robot V :=
      {| explored := explored r; blocked := blocked r; place := place r; doing := Stands; aim := None; waits := false;
         news := true; told := told r |}.
    Definition lands (r : robot V) (v : V) : robot V :=
      {| explored := join (explored r) [v]; blocked := blocked r; place := v; doing := Stands;
         aim := match aim r with Some c => if claims rl && negb (same c v) then Some c else None | None => None end;
         waits := waits r; news := news r || grows_by (explored r) [v]; told := told r |}.

    (** Slots count while a robot waits. *)
    Definition settle (w : world V) : world V :=
      if some (waiting w) then w
      else {| robots := robots w; been := been w; slot := 0; old := []; tried := false |}.
    Definition with_robots (w : world V) (f : nat -> robot V) : world V :=
      {| robots := f; been := been w; slot := slot w; old := old w; tried := tried w |}.

    Definition next (w : world V) (e : event V) : option (world V) :=
      match e with
      | Decides i v c missed =>
          if (i <? N) && may_decide w i
             && existsb (fun p => same (fst p) v && same (snd p) c) (chooses rl i (robots w i))
          then let r := robots w i in
               let f := put (robots w) i (becomes r (Tries v) (Some c) (waits r)) in
               Some (with_robots w (if claims rl then tells f i missed else f))
          else None
      | Looks i missed unheard s =>
          let r := robots w i in
          match doing r with
          | Tries v => if negb ((i <? N) && (s <? N)) then None else
              match meets w i v with
              | [] => let r := if obstacle v then blocks r v
                        else if late r v then turns r else becomes r (Enters v) (aim r) false in
                      let f := put (robots w) i r in
                      Some (settle (with_robots w (if obstacle v then tells f i missed else f)))
              | met =>
                  let f := tells (put (robots w) i (becomes r Stands None true)) i missed in
                  let f := is_told f i (filter (fun j => negb (is_in j unheard)) met) in
                  let s := if some (waiting w) then slot w else s in
                  Some (settle {| robots := f; been := been w; slot := s; old := old w;
                                  tried := (some (waiting w) && tried w) || (s =? i) |})
              end
          | _ => None
          end
      | Arrives i missed =>
          let r := robots w i in
          match doing r with
          | Enters v => if i <? N then
              Some (settle {| robots := tells (put (robots w) i (lands r v)) i missed; been := v :: been w;
                              slot := slot w; old := old w; tried := tried w |})
              else None
          | _ => None
          end
      | Ticks => if may_tick w
          then Some {| robots := robots w; been := been w; slot := (slot w + 1) mod N;
                       old := filter (moves w) (seq 0 N); tried := false |}
          else None
      end.
  End Rule.

  (** ** The two rules. *)
  (** The cells from which [c] is reached in one move more than from those of [B], through explored cells. *)
  Definition grows (e : list V) (c : V) (B : list V) : list V :=
    filter (fun u => has B u ||| existsb (fun v => has B v &&& (same v c || has e v)) (beside u)) cells.
  (** How many moves lead from [u] to [c], or [most] if there are not so few. *)
  Fixpoint moves_from (e : list V) (c : V) (B : list V) (most : nat) (u : V) : nat :=
    match most with O => 0 | S m => if has B u then 0 else S (moves_from e c (grows e c B) m u) end.
  Definition far (e : list V) (u c : V) : nat := moves_from e c [c] (S (length cells)) u.
  (** The unknown cells that are reached from [u] through explored ones. *)
  Definition targets (r : robot V) (u : V) : list V :=
    filter (fun c => negb (has (explored r) c) &&& negb (has (blocked r) c) &&& negb (same u c)
      &&& (far (explored r) u c <=? length cells)) cells.
  (** The first cells of the shortest ways to [c]. *)
  Definition firsts (r : robot V) (c : V) : list V :=
    filter (fun v => (same v c || has (explored r) v)
      &&& (S (far (explored r) v c) =? far (explored r) (place r) c)) (beside (place r)).

  (** Plain: it goes to any of the nearest unknown cells, any shortest way. *)
  Definition nearest (r : robot V) : list V :=
    let t := targets r (place r) in
    filter (fun c => forallb (fun d => far (explored r) (place r) c <=? far (explored r) (place r) d) t) t.
  Definition PLAIN : rule V :=
    {| chooses := fun _ r => flat_map (fun c => map (fun v => (v, c)) (firsts r c)) (nearest r); claims := false; returns := true |}.

  (** Repaired: robots and unknown cells are paired, the least pair first. Cells have numbers, and a distance to the rim
      of the area. *)
  Section Pairs.
  Variables number rim : V -> nat.
  Definition seeker : Type := V * option V.
  Record pair := { seeks : V; sought : V; rank : list nat }.
  Fixpoint less (l m : list nat) : bool :=
    match l, m with a :: l, b :: m => (a <? b) || ((a =? b) && less l m) | _, _ => false end.
  Definition pair_of (r : robot V) (s : seeker) (c : V) : pair :=
    {| seeks := fst s; sought := c;
       rank := [far (explored r) (fst s) c;
                match snd s with Some a => if same a c then 0 else 1 | None => 1 end;
                length (filter (fun v => negb (has (explored r) v) && negb (has (blocked r) v)) (beside c));
                rim c; number (fst s); number c] |}.
  Definition pairs (r : robot V) (s : seeker) : list pair := map (pair_of r s) (targets r (fst s)).
  (** Robots that are taken to be in one cell count as one. *)
  Definition seekers (i : nat) (r : robot V) : list seeker :=
    fold_left (fun l j => if (j =? i) || has (map fst l) (fst (told r j)) then l else l ++ [told r j]) (seq 0 N)
      [(place r, aim r)].
  Definition first (ps : list pair) : option pair :=
    fold_left (fun m p => match m with Some q => if less (rank p) (rank q) then Some p else m | None => Some p end) ps
      None.
  (** The own pair, when all lesser ones and what is in them are taken away. *)
  Fixpoint paired (turns : nat) (u : V) (ps : list pair) : option pair :=
    match turns, first ps with
    | S turns, Some p => if same (seeks p) u then Some p
        else paired turns u (filter (fun q => negb (same (seeks q) (seeks p)) && negb (same (sought q) (sought p))) ps)
    | _, _ => None
    end.
  (** It goes to the cell of its pair, or to the one that comes first for it, if it has no pair, or if that is farther, without
      news, than the cell that it has claimed, or than a nearest one if it has claimed none. *)
  Definition PAIRED (keeps : bool) : rule V :=
    {| chooses := fun i r =>
         let own := pairs r (place r, aim r) in
         let all := flat_map (pairs r) (seekers i r) in
         match first own with
         | Some f =>
             let p := match paired N (place r) all with Some p => p | None => f end in
             let kept := match aim r with Some a => a | None => sought f end in
             let c := if keeps &&& negb (news r)
                        &&& (far (explored r) (place r) kept <? far (explored r) (place r) (sought p))
                      then sought f else sought p in
             match firsts r c with v :: _ => [(v, c)] | [] => [] end
         | None => []
         end;
       claims := true; returns := true |}.
  Definition REPAIRED : rule V := PAIRED true.
  End Pairs.

  (** ** Runs. *)
  (** All robots start in different free cells, and know these. *)
  Definition begins (start : nat -> V) : world V :=
    {| robots := fun i => {| explored := map start (seq 0 N); blocked := []; place := start i; doing := Stands;
         aim := None; waits := false; news := true; told := fun j => (start j, None) |};
       been := map start (seq 0 N); slot := 0; old := []; tried := false |}.
  (** Of robots that there are not nothing is said. *)
  Definition alike (w w' : world V) : Prop :=
    (forall i, i < N -> robots w i = robots w' i) /\ been w = been w' /\ slot w = slot w' /\ old w = old w'
    /\ tried w = tried w'.
  Definition may_start (start : nat -> V) : Prop :=
    (forall i, i < N -> In (start i) cells /\ obstacle (start i) = false)
    /\ forall i j, i < N -> j < N -> start i = start j -> i = j.
  Definition leads (rl : rule V) (w : world V) (e : event V) (w' : world V) : Prop :=
    exists x, next rl w e = Some x /\ alike x w'.
  Inductive run (rl : rule V) : world V -> Prop :=
  | run_start : forall start w, may_start start -> alike (begins start) w -> run rl w
  | run_step : forall w e w', run rl w -> leads rl w e w' -> run rl w'.
  Definition ended (rl : rule V) (w : world V) : Prop := forall e w', ~ leads rl w e w'.

  (** Through explored cells of a map a way leads from a cell to [c]. *)
  Inductive way (e : list V) (c : V) : V -> Prop :=
  | way_last : forall u, In c (beside u) -> way e c u
  | way_over : forall u v, In v (beside u) -> In v e -> way e c v -> way e c u.
  (** Free cells lead from one cell to another one. *)
  Inductive joined (u : V) : V -> Prop :=
  | joined_self : joined u u
  | joined_over : forall v w, joined u v -> In w (beside v) -> obstacle w = false -> joined u w.

  Lemma join_in : forall l m v, In v (join l m) -> In v l \/ In v m.
  Proof. intros l m v I; apply in_app_or in I; destruct I as [I|I]; [auto|]. apply filter_In in I; tauto. Qed.
  Lemma join_left : forall l m v, In v l -> In v (join l m). Proof. intros; apply in_or_app; auto. Qed.
  Lemma meets_robots : forall w i v j, In j (meets w i v) -> j < N.
  Proof. intros w i v j I; apply filter_In in I; destruct I as [I _]; apply in_seq in I; lia. Qed.
  Lemma settle_robots : forall rl w, robots (settle rl w) = robots w /\ been (settle rl w) = been w.
  Proof. intros rl w; unfold settle; destruct (some _); auto. Qed.
  Lemma alike_self : forall w, alike w w. Proof. intros w; repeat split. Qed.
  Lemma some_spec : forall f, some f = true <-> exists i, i < N /\ f i = true.
  Proof.
    intros f; unfold some; rewrite existsb_exists; split; intros [i [I E]]; exists i; split; auto;
      [apply in_seq in I; lia | apply in_seq; lia].
  Qed.
  Lemma first_some : forall ps, first ps = None -> ps = [].
  Proof.
    intros ps; unfold first; destruct ps as [|p ps]; [reflexivity|]; cbn. generalize p; clear p.
    induction ps as [|q ps IH]; intros p E; cbn in E; [discriminate|]. destruct (less _ _); eapply IH in E; discriminate.
  Qed.
  Lemma first_in : forall ps p, first ps = Some p -> In p ps.
  Proof.
    intros ps p; unfold first; assert (forall ps m, fold_left (fun m p => match m with Some q => if less (rank p) (rank q)
      then Some p else m | None => Some p end) ps m = Some p -> m = Some p \/ In p ps) as G.
    { clear; induction ps as [|q ps IH]; intros m E; cbn in E; [auto|]. apply IH in E; destruct E as [E|E]; [|cbn; auto].
      destruct m as [x|]; [destruct (less _ _); [injection E as ->; cbn; auto | auto] | injection E as ->; cbn; auto]. }
    intros E; apply G in E; destruct E; [discriminate | assumption].
  Qed.

  Hypothesis same_spec : forall a b, same a b = true <-> a = b.
  Hypothesis beside_cells : forall u v, In v (beside u) -> In v cells.
  Set Default Proof Using "same_spec beside_cells".

  (** ** FRONTIER-5, by any rule. *)
  Definition sound (b : list V) (r : robot V) : Prop :=
    (forall v, In v (explored r) -> In v b) /\ (forall v, In v (blocked r) -> obstacle v = true).

  Lemma has_in : forall l v, has l v = true <-> In v l.
  Proof.
    intros l v; unfold has; rewrite existsb_exists; split; [|exists v; split; [assumption | now apply same_spec]].
    intros [x [I E]]; apply same_spec in E; now subst.
  Qed.
  Lemma in_join : forall l m v, In v l \/ In v m -> In v (join l m).
  Proof.
    intros l m v H; apply in_or_app; destruct (has l v) eqn:X; [left; now apply has_in|]. destruct H as [I|I]; [auto|].
    right; apply filter_In; now rewrite X.
  Qed.
  Lemma sound_hears : forall b r j said, sound b r -> sound b said -> sound b (hears r j said).
  Proof. intros b r j said [A B] [C D]; split; cbn; intros v I; apply join_in in I; destruct I; auto. Qed.
  Lemma sound_tells : forall b f i missed, (forall j, j < N -> sound b (f j)) -> i < N ->
    forall j, j < N -> sound b (tells f i missed j).
  Proof. intros b f i missed S I j J; unfold tells; destruct (_ || _); [auto | apply sound_hears; auto]. Qed.
  Lemma sound_put : forall b (f : nat -> robot V) i r, (forall j, j < N -> sound b (f j)) -> sound b r ->
    forall j, j < N -> sound b (put f i r j).
  Proof. intros b f i r S R j J; unfold put; destruct (j =? i); auto. Qed.
  Lemma sound_told : forall b f i l, (forall j, j < N -> sound b (f j)) -> i < N -> (forall j, In j l -> j < N) ->
    forall j, j < N -> sound b (is_told f i l j).
  Proof.
    intros b f i l S I L; apply sound_put; [exact S|]. specialize (S i I) as R; revert R; generalize (f i).
    induction l as [|k l IH]; intros r R; cbn; [exact R|]. apply IH; [intros; apply L; now right|].
    apply sound_hears; [exact R | apply S, L; now left].
  Qed.
  Lemma sound_more : forall b c r, (forall v, In v b -> In v c) -> sound b r -> sound c r.
  Proof. intros b c r M [A B]; split; auto. Qed.


  Lemma next_sound : forall rl w e x, (forall i, i < N -> sound (been w) (robots w i)) -> next rl w e = Some x ->
    forall i, i < N -> sound (been x) (robots x i).
  Proof.
    intros rl w e x S E; destruct e as [i v c missed | i missed unheard s | i missed |]; cbn [next] in E.
    - destruct (_ && _) eqn:G; [|discriminate]; injection E as <-; rewrite !andb_true_iff in G; destruct G as [[G _] _].
      apply Nat.ltb_lt in G; cbn.
      assert (forall j, j < N -> sound (been w) (put (robots w) i (becomes (robots w i) (Tries v) (Some c)
        (waits (robots w i))) j)) as P by (apply sound_put; [exact S | exact (S i G)]).
      destruct (claims rl); [now apply sound_tells | exact P].
    - destruct (doing _) as [|v|v]; try discriminate. destruct (i <? N) eqn:G; [|discriminate].
      destruct (s <? N); [|discriminate]; cbn [andb negb] in E; apply Nat.ltb_lt in G.
      destruct (meets w i v) as [|m met] eqn:M; [|rewrite <- M in E]; injection E as <-.
      + rewrite (proj1 (settle_robots rl _)), (proj2 (settle_robots rl _)); cbn. destruct (obstacle v) eqn:O.
        * apply sound_tells; [|exact G]. apply sound_put; [exact S|]. destruct (S i G) as [A B]; split; cbn; [exact A|].
          intros x I; apply join_in in I; destruct I as [I|[<-|[]]]; auto.
        * apply sound_put; [exact S | destruct (late _ _ _); exact (S i G)].
      + rewrite (proj1 (settle_robots rl _)), (proj2 (settle_robots rl _)); cbn [robots been].
        apply sound_told; [|exact G|]; [apply sound_tells; [apply sound_put; [exact S | exact (S i G)] | exact G]|].
        intros j I; apply filter_In in I; destruct I as [I _]; eapply meets_robots; eauto.
    - destruct (doing _) as [|v|v]; try discriminate. destruct (i <? N) eqn:G; [|discriminate]; apply Nat.ltb_lt in G.
      injection E as <-; rewrite (proj1 (settle_robots rl _)), (proj2 (settle_robots rl _)); cbn.
      apply sound_tells; [|exact G]. apply sound_put.
      + intros j J; apply sound_more with (b := been w); auto; cbn; auto.
      + destruct (S i G) as [A B]; split; cbn; [|exact B].
        intros x I; apply join_in in I; destruct I as [I|[<-|[]]]; auto.
    - destruct (may_tick _ _); [|discriminate]; injection E as <-; exact S.
  Qed.

  Lemma sound_always : forall rl w, run rl w -> forall i, i < N -> sound (been w) (robots w i).
  Proof.
    intros rl w R; induction R as [start w _ [A [B _]] | w e w' R IH [x [E [A [B _]]]]]; intros i I; rewrite <- A, <- B by exact I.
    - split; cbn; [auto | tauto].
    - eapply next_sound; eauto.
  Qed.

  (** A robot takes a cell for explored only where a robot was, and for an obstacle only where one is, whatever is missed. *)
  Theorem FRONTIER_5 : forall rl w, run rl w -> forall i, i < N ->
    (forall v, In v (explored (robots w i)) -> In v (been w))
    /\ (forall v, In v (blocked (robots w i)) -> obstacle v = true).
  Proof. exact sound_always. Qed.

  (** ** FRONTIER-4. *)

  Lemma slot_always : forall rl w, run rl w -> 0 < N -> slot w < N.
  Proof.
    assert (forall rl w, slot w < N -> 0 < N -> slot (settle rl w) < N) as St
      by (intros rl w S P; unfold settle; destruct (some _); auto).
    intros rl w R P; induction R as [start w _ [_ [_ [S _]]] | w e w' R IH [x [E [_ [_ [S _]]]]]]; rewrite <- S; [exact P|].
    destruct e as [i v c missed | i missed unheard s | i missed |]; cbn [next] in E.
    - destruct (_ && _); [|discriminate]; injection E as <-; exact IH.
    - destruct (doing _); try discriminate. destruct (i <? N); [|discriminate].
      destruct (s <? N) eqn:L; [|discriminate]; apply Nat.ltb_lt in L.
      destruct (meets w i v); injection E as <-; apply St; cbn; auto. now destruct (some _).
    - destruct (doing _); try discriminate. destruct (i <? N); [|discriminate]; injection E as <-; now apply St.
    - destruct (may_tick _ _); [|discriminate]; injection E as <-; cbn; apply Nat.mod_upper_bound; lia.
  Qed.

  (** A run that has ended leaves no robot under way, nor one that would go on. *)
  Lemma ended_all : forall rl w, run rl w -> ended rl w -> forall i, i < N -> doing (robots w i) = Stands /\ would rl w i = false.
  Proof.
    intros rl w R E.
    assert (forall e, next rl w e = None) as No.
    { intros e; destruct (next rl w e) as [x|] eqn:X; [|reflexivity]. exfalso; apply (E e x); exists x; split;
        [exact X | apply alike_self]. }
    assert (forall i, i < N -> doing (robots w i) = Stands) as St.
    { intros i I; destruct (doing (robots w i)) as [|v|v] eqn:D; [reflexivity| |].
      - specialize (No (Looks i [] [] i)); cbn [next] in No; rewrite D, (proj2 (Nat.ltb_lt i N) I) in No; cbn in No.
        destruct (meets w i v); discriminate.
      - specialize (No (Arrives i [])); cbn [next] in No; rewrite D, (proj2 (Nat.ltb_lt i N) I) in No; discriminate. }
    assert (forall i, i < N -> may_decide rl w i = false) as Dec.
    { intros i I; destruct (may_decide rl w i) eqn:M; [|reflexivity]; pose proof M as M'. unfold may_decide in M.
      rewrite !andb_true_iff in M; destruct M as [[_ M] _]; unfold would in M.
      destruct (chooses rl i (robots w i)) as [|[v c] l] eqn:C; [discriminate|].
      specialize (No (Decides i v c [])); cbn [next] in No; rewrite M', C, (proj2 (Nat.ltb_lt i N) I) in No.
      cbn in No; rewrite (proj2 (same_spec v v) eq_refl), (proj2 (same_spec c c) eq_refl) in No; discriminate. }
    intros i I; split; [auto|]. destruct (would rl w i) eqn:W; [|reflexivity].
    pose proof (Dec i I) as D; unfold may_decide, moves in D; rewrite (St i I), W in D; cbn in D.
    apply orb_false_iff in D; destruct D as [D _]; apply negb_false_iff in D.
    specialize (No Ticks); cbn [next] in No. destruct (may_tick rl w) eqn:T; [discriminate|].
    exfalso; unfold may_tick in T; apply not_true_iff_false in T; apply T. rewrite !andb_true_iff; repeat split.
    - apply some_spec; exists i; split; [exact I|]. unfold waiting; now rewrite D, W.
    - apply negb_true_iff, not_true_iff_false; intros X; apply andb_true_iff in X; destruct X as [X Y].
      unfold waiting in X; apply andb_true_iff in X; destruct X as [X1 X2].
      assert (slot w < N) as L by (eapply slot_always; eauto; lia).
      pose proof (Dec _ L) as Z; unfold may_decide, moves in Z.
      rewrite (St _ L), X1, X2, Y, Nat.eqb_refl in Z; discriminate.
    - apply negb_true_iff, not_true_iff_false; intros X; apply some_spec in X; destruct X as [j [J X]].
      unfold moves in X; rewrite (St j J) in X; discriminate.
  Qed.

  (** ** Distances. *)
  Section Far.
    Variables (e : list V) (c : V).
    Hypothesis c_cell : In c cells.
    Set Default Proof Using "same_spec beside_cells c_cell".

    Fixpoint grown (n : nat) : list V := match n with O => [c] | S n => grows e c (grown n) end.
    Lemma grown_S : forall n u, In u (grown (S n)) <->
      In u cells /\ (In u (grown n) \/ exists v, In v (beside u) /\ In v (grown n) /\ (v = c \/ In v e)).
    Proof. clear obstacle.
      intros n u; cbn [grown]; unfold grows; rewrite filter_In, lazy_or, orb_true_iff, has_in, existsb_exists.
      split; intros [I H]; split; auto; (destruct H as [H|[v H]]; [auto|]); right; exists v;
        rewrite lazy_and, ?andb_true_iff, ?orb_true_iff, ?has_in, ?same_spec in *; intuition auto.
    Qed.
    Lemma grown_cells : forall n u, In u (grown n) -> In u cells.
    Proof. clear obstacle. destruct n; intros u I; [destruct I as [<-|[]]; auto | apply grown_S in I; tauto]. Qed.
    Lemma grown_more : forall n m u, n <= m -> In u (grown n) -> In u (grown m).
    Proof.
      intros n m u L I; induction L as [|m L IH]; [exact I|]. apply grown_S; split; [eapply grown_cells; eauto | auto].
    Qed.

    (** After as many turns as there are cells nothing is added. *)
    Lemma grown_stable : forall n, (exists m, m <= n /\ forall u, In u (grown (S m)) -> In u (grown m))
      \/ n < length (filter (has (grown n)) cells).
    Proof.
      induction n as [|n [[m [L IH]]|IH]].
      - right; assert (In c (filter (has (grown 0)) cells)) as I by (apply filter_In; split; [exact c_cell |
          apply has_in; cbn; auto]). destruct (filter _ _); [destruct I | cbn; lia].
      - left; exists m; auto.
      - destruct (existsb (fun u => negb (has (grown n) u)) (filter (has (grown (S n))) cells)) eqn:X.
        + right; apply existsb_exists in X; destruct X as [u [I X]]; apply filter_In in I; destruct I as [I J].
          assert (length (filter (has (grown n)) cells) < length (filter (has (grown (S n))) cells)); [|lia].
          apply filter_less; [intros x Hx; apply has_in in Hx; apply has_in; eapply grown_more; [|eauto]; lia|].
          exists u; apply negb_true_iff in X; auto.
        + left; exists n; split; [lia|]; intros u I. apply has_in; destruct (has (grown n) u) eqn:Y; [reflexivity|].
          exfalso; apply not_true_iff_false in X; apply X; apply existsb_exists; exists u; rewrite Y; split; [|reflexivity].
          apply filter_In; split; [eapply grown_cells; eauto | now apply has_in].
    Qed.
    Lemma stable_on : forall m n u, (forall u, In u (grown (S m)) -> In u (grown m)) -> In u (grown n) -> m <= n ->
      In u (grown m).
    Proof.
      intros m n u H I L; revert u I; induction L as [|n L IH]; intros u I; [exact I|].
      apply grown_S in I; apply H, grown_S; destruct I as [C [I|[v [B [I E]]]]]; split; auto.
      right; exists v; auto.
    Qed.
    Lemma grown_all : forall n u, In u (grown n) -> In u (grown (length cells)).
    Proof.
      intros n u I; destruct (grown_stable (length cells)) as [[m [L H]]|L].
      - apply (grown_more m); [exact L|]. destruct (le_lt_dec m n) as [K|K]; [now apply (stable_on m n)|].
        apply (grown_more n); [lia | exact I].
      - exfalso. assert (forall f : V -> bool, length (filter f cells) <= length cells) as F; [|specialize (F (has (grown (length cells)))); lia].
        clear; induction cells as [|x r IH]; intros f; cbn; [lia|]. destruct (f x); cbn; specialize (IH f); lia.
    Qed.

    (** The distance of [u] is the first turn in which it is reached. *)
    Lemma moves_spec : forall m k u, moves_from e c (grown k) m u < m ->
      In u (grown (k + moves_from e c (grown k) m u))
      /\ forall n, n < moves_from e c (grown k) m u -> ~ In u (grown (k + n)).
    Proof.
      induction m as [|m IH]; intros k u L; [cbn in L; lia|]. cbn [moves_from] in *.
      destruct (has (grown k) u) eqn:H.
      - rewrite Nat.add_0_r; split; [now apply has_in | lia].
      - specialize (IH (S k) u); cbn [grown] in IH; destruct IH as [A B]; [lia|].
        rewrite Nat.add_succ_r; split; [exact A|]. intros [|n] Ln.
        + rewrite Nat.add_0_r, <- has_in; congruence.
        + rewrite Nat.add_succ_r; apply B; lia.
    Qed.
    Lemma moves_least : forall m k n u, n < m -> In u (grown (k + n)) -> moves_from e c (grown k) m u <= n.
    Proof.
      induction m as [|m IH]; intros k n u L I; [lia|]. cbn [moves_from]; destruct (has (grown k) u) eqn:H; [lia|].
      destruct n as [|n]; [rewrite Nat.add_0_r, <- has_in in I; congruence|].
      specialize (IH (S k) n u); cbn [grown] in IH; rewrite Nat.add_succ_r in I; specialize (IH ltac:(lia) I); lia.
    Qed.
    Lemma far_grown : forall u, In u (grown (length cells)) <-> far e u c <= length cells.
    Proof.
      intros u; unfold far; split; intros H.
      - apply (moves_least (S (length cells)) 0 (length cells)); [lia | exact H].
      - destruct (moves_spec (S (length cells)) 0 u) as [A _]; [cbn [grown]; lia|]. eapply grown_all; exact A.
    Qed.
    Lemma far_most : forall n u, In u (grown n) -> far e u c <= n.
    Proof.
      intros n u I; destruct (le_lt_dec n (length cells)) as [L|L].
      - apply (moves_least (S (length cells)) 0 n); [lia | exact I].
      - apply grown_all, far_grown in I; lia.
    Qed.
    Lemma far_least : forall n u, far e u c <= length cells -> n < far e u c -> ~ In u (grown n).
    Proof. intros n u L M; destruct (moves_spec (S (length cells)) 0 u) as [_ B]; [cbn [grown]; fold (far e u c); lia|]. now apply B. Qed.
    Lemma far_in : forall u, far e u c <= length cells -> In u (grown (far e u c)).
    Proof. intros u L; destruct (moves_spec (S (length cells)) 0 u) as [B _]; [cbn [grown]; fold (far e u c); lia|]. exact B. Qed.

    (** The next cell of a way is nearer by one. *)
    Lemma far_step : forall u v, In u cells -> In v (beside u) -> v = c \/ In v e -> far e v c <= length cells ->
      far e u c <= S (far e v c).
    Proof.
      intros u v C B E L; apply far_most, grown_S; split; [exact C|]. right; exists v; repeat split; auto. now apply far_in.
    Qed.
    Lemma far_next : forall u, far e u c <= length cells -> u <> c ->
      exists v, In v (beside u) /\ (v = c \/ In v e) /\ S (far e v c) = far e u c.
    Proof.
      intros u L D; pose proof (far_in u L) as I; destruct (far e u c) as [|d] eqn:F; [destruct I as [<-|[]]; congruence|].
      apply grown_S in I; destruct I as [C [I|[v [B [I E]]]]]; [apply far_most in I; lia|].
      exists v; repeat split; auto. apply far_most in I as G. assert (far e v c <= length cells) as Lv by lia.
      pose proof (far_step u v C B E Lv); lia.
    Qed.
    Lemma way_far : forall u, In u cells -> way e c u -> far e u c <= length cells.
    Proof.
      intros u C W; induction W as [u B | u v B E W IH]; apply far_grown.
      - apply (grown_all 1), grown_S; split; [exact C|]; right; exists c; cbn; auto.
      - apply (grown_all (S (length cells))), grown_S; split; [exact C|]; right; exists v; repeat split; auto.
        apply far_grown, IH; eapply beside_cells; eauto.
    Qed.
  End Far.
  Set Default Proof Using "same_spec beside_cells".

  (** ** Where robots are. *)
  (** A rule sends robots to cells beside theirs, and as long as a way to an unknown cell is known. *)
  Definition sensible (rl : rule V) : Prop :=
    (forall i r v c, In (v, c) (chooses rl i r) -> In v (beside (place r)))
    /\ forall i r, chooses rl i r = [] -> targets r (place r) = [].

  Lemma paired_in : forall n u ps p, paired n u ps = Some p -> In p ps /\ seeks p = u.
  Proof. clear obstacle.
    induction n as [|n IH]; intros u ps p E; cbn in E; [discriminate|]. destruct (first ps) as [q|] eqn:F; [|discriminate].
    destruct (same (seeks q) u) eqn:S.
    - injection E as <-; split; [now apply first_in | now apply same_spec].
    - apply IH in E; destruct E as [I E]; split; [apply filter_In in I; tauto | exact E].
  Qed.
  Lemma targets_spec : forall r u c, In c (targets r u) <->
    In c cells /\ ~ In c (explored r) /\ ~ In c (blocked r) /\ u <> c /\ far (explored r) u c <= length cells.
  Proof. clear obstacle.
    intros r u c; unfold targets; rewrite filter_In, !lazy_and, !andb_true_iff, !negb_true_iff, Nat.leb_le.
    rewrite <- !not_true_iff_false, !has_in, same_spec; tauto.
  Qed.
  Lemma firsts_spec : forall r c v, In v (firsts r c) <-> In v (beside (place r)) /\ (v = c \/ In v (explored r))
    /\ S (far (explored r) v c) = far (explored r) (place r) c.
  Proof. clear obstacle.
    intros r c v; unfold firsts; rewrite filter_In, lazy_and, andb_true_iff, orb_true_iff, same_spec, has_in, Nat.eqb_eq; tauto.
  Qed.
  Lemma firsts_some : forall r c, In c (targets r (place r)) -> firsts r c <> [].
  Proof.
    intros r c I E; apply targets_spec in I; destruct I as [C [_ [_ [D L]]]].
    destruct (far_next _ _ C _ L D) as [v [B [A F]]].
    assert (In v (firsts r c)) as I by (apply firsts_spec; auto). now rewrite E in I.
  Qed.

  Lemma nearest_spec : forall r c, In c (nearest r) <-> In c (targets r (place r)) /\ forall d,
    In d (targets r (place r)) -> far (explored r) (place r) c <= far (explored r) (place r) d.
  Proof.
    intros r c; unfold nearest; rewrite filter_In, forallb_forall; split; intros [I F]; split; auto; intros d J;
      [apply Nat.leb_le | apply Nat.leb_le]; auto.
  Qed.
  Lemma nearest_some : forall r, nearest r = [] -> targets r (place r) = [].
  Proof.
    intros r E; destruct (targets r (place r)) as [|c l] eqn:T; [reflexivity|exfalso].
    assert (forall (f : V -> nat) l (c : V), exists m, In m (c :: l) /\ forall d, In d (c :: l) -> f m <= f d) as Min.
    { clear; intros f; induction l as [|x l IH]; intros c; [exists c; split; [cbn; auto | intros d [<-|[]]; auto]|].
      destruct (IH x) as [m [I M]]; destruct (le_lt_dec (f c) (f m)) as [L|L].
      - exists c; split; [cbn; auto|]; intros d [<-|J]; [auto | apply M in J; lia].
      - exists m; split; [now right|]; intros d [<-|J]; [lia | auto]. }
    destruct (Min (far (explored r) (place r)) l c) as [m [I M]]; rewrite <- T in I, M.
    assert (In m (nearest r)) as J by (apply nearest_spec; auto). now rewrite E in J.
  Qed.

  Lemma plain_spec : forall i r v c, In (v, c) (chooses PLAIN i r) <-> In c (nearest r) /\ In v (firsts r c).
  Proof.
    intros i r v c; cbn; rewrite in_flat_map; split.
    - intros [d [I J]]; apply in_map_iff in J; destruct J as [u [E J]]; injection E as -> ->; auto.
    - intros [I J]; exists c; split; [exact I | now apply (in_map (fun v => (v, c)))].
  Qed.
  Theorem plain_sensible : sensible PLAIN.
  Proof.
    split.
    - intros i r v c I; apply plain_spec in I; destruct I as [_ I]; now apply firsts_spec in I.
    - intros i r E; apply nearest_some; destruct (nearest r) as [|c l] eqn:T; [reflexivity|exfalso].
      assert (In c (nearest r)) as I by (rewrite T; cbn; auto). apply nearest_spec in I as J; destruct J as [J _].
      apply firsts_some in J; destruct (firsts r c) as [|v m] eqn:F; [congruence|].
      assert (In (v, c) (chooses PLAIN i r)) as X by (apply plain_spec; rewrite F; cbn; auto). now rewrite E in X.
  Qed.
  (** The pair that comes first has a nearest cell. *)
  Lemma first_nearest : forall number rim r f, first (pairs number rim r (place r, aim r)) = Some f -> In (sought f) (nearest r).
  Proof.
    intros number rim r f E; set (d := fun p : pair => hd 0 (rank p)).
    assert (forall ps m, (forall p, m = Some p \/ In p ps -> rank p <> []) -> fold_left (fun m p => match m with
      Some q => if less (rank p) (rank q) then Some p else m | None => Some p end) ps m = Some f ->
      forall q, m = Some q \/ In q ps -> d f <= d q) as Least.
    { clear; induction ps as [|p ps IH]; intros m S E q H; cbn in E; [destruct H as [->|[]]; now injection E as ->|].
      assert (forall x, m = Some x -> if less (rank p) (rank x) then d p <= d x else d x <= d p) as Le.
      { intros x X; pose proof (S p (or_intror (or_introl eq_refl))) as Sp; pose proof (S x (or_introl X)) as Sx.
        unfold d; destruct (rank p) as [|a l], (rank x) as [|b k]; try congruence; cbn [less hd].
        destruct (a <? b) eqn:L; cbn [orb]; [apply Nat.ltb_lt in L; lia|]. apply Nat.ltb_ge in L.
        destruct (a =? b) eqn:Eq; cbn [andb]; [apply Nat.eqb_eq in Eq; destruct (less l k); lia | exact L]. }
      destruct m as [x|]; [specialize (Le x eq_refl); destruct (less (rank p) (rank x))|].
      - assert (forall q, Some p = Some q \/ In q ps -> d f <= d q) as I
          by (apply (IH (Some p)); [intros y [Y|Y]; apply S; [injection Y as ->; right; now left | right; now right] | exact E]).
        specialize (I p (or_introl eq_refl)) as Ip. destruct H as [H|[<-|H]]; [injection H as <-; lia | exact Ip | auto].
      - assert (forall q, Some x = Some q \/ In q ps -> d f <= d q) as I
          by (apply (IH (Some x)); [intros y [Y|Y]; apply S; [now left | right; now right] | exact E]).
        specialize (I x (or_introl eq_refl)) as Ix. destruct H as [H|[<-|H]]; [injection H as <-; exact Ix | lia | auto].
      - assert (forall q, Some p = Some q \/ In q ps -> d f <= d q) as I
          by (apply (IH (Some p)); [intros y [Y|Y]; apply S; [injection Y as ->; right; now left | right; now right] | exact E]).
        destruct H as [H|[<-|H]]; [discriminate | auto | auto]. }
    pose proof (first_in _ _ E) as I; apply in_map_iff in I; destruct I as [c [<- I]]; cbn [sought pair_of].
    apply nearest_spec; split; [exact I|]; intros x J. refine (Least _ None _ E (pair_of number rim r (place r, aim r) x) _).
    - intros p [X|X]; [discriminate | apply in_map_iff in X; destruct X as [y [<- _]]; discriminate].
    - right; unfold pairs; now apply in_map.
  Qed.
  Lemma pair_left : forall number rim i r f, first (pairs number rim r (place r, aim r)) = Some f ->
    In (sought (match paired N (place r) (flat_map (pairs number rim r) (seekers i r)) with Some p => p | None => f end))
      (targets r (place r)).
  Proof.
    intros number rim i r f F; destruct (paired _ _ _) as [p|] eqn:P; [|apply first_nearest, nearest_spec in F; apply F].
    apply paired_in in P; destruct P as [I S]; apply in_flat_map in I; destruct I as [s [_ I]].
    apply in_map_iff in I; destruct I as [d [<- I]]; cbn in S |- *; now rewrite <- S.
  Qed.
  (** Where a robot goes: to a cell that is left, and, if it keeps to its claim, to none that is farther. *)
  Lemma paired_spec : forall number rim k i r v c, In (v, c) (chooses (PAIRED number rim k) i r) ->
    In c (targets r (place r)) /\ In v (firsts r c) /\ (k = true -> news r = false -> match aim r with
      | Some a => In a (targets r (place r)) -> far (explored r) (place r) c <= far (explored r) (place r) a
      | None => In c (nearest r) end).
  Proof.
    intros number rim k i r v c; cbn [chooses PAIRED]; destruct (first _) as [f|] eqn:F; [|intros []].
    pose proof (pair_left number rim i r f F) as Ip; apply first_nearest, nearest_spec in F; destruct F as [If Nf].
    set (p := match paired _ _ _ with Some p => p | None => f end) in *.
    match goal with |- context [if ?x then sought f else sought p] => destruct x eqn:B end; rewrite ?lazy_and in B.
    - destruct (firsts r (sought f)) as [|x l] eqn:Fi; [intros []|]; intros [E|[]]; injection E as -> <-.
      split; [exact If|]; split; [rewrite Fi; now left|]. intros _ _; destruct (aim r); [now apply Nf | now apply nearest_spec].
    - destruct (firsts r (sought p)) as [|x l] eqn:Fi; [intros []|]; intros [E|[]]; injection E as -> <-.
      split; [exact Ip|]; split; [rewrite Fi; now left|]. intros -> Nw; rewrite Nw in B; cbn [negb andb] in B; apply Nat.ltb_ge in B.
      destruct (aim r) as [a|]; [now intros _|]. apply nearest_spec; split; [exact Ip|]. intros x J; specialize (Nf _ J); lia.
  Qed.
  Theorem paired_sensible : forall number rim k, sensible (PAIRED number rim k).
  Proof.
    intros number rim k; split; intros i r.
    - intros v c I; apply paired_spec in I; destruct I as [_ [I _]]; now apply firsts_spec in I.
    - cbn [chooses PAIRED]; destruct (first _) as [f|] eqn:F; [|intros _; apply first_some in F; unfold pairs in F; now apply map_eq_nil in F].
      pose proof (pair_left number rim i r f F) as Ip; apply firsts_some in Ip; apply first_nearest, nearest_spec in F.
      destruct F as [If _]; apply firsts_some in If; intros E; exfalso; revert E.
      match goal with |- context [if ?x then sought f else _] => destruct x end;
        match goal with |- match firsts r ?c with _ => _ end = _ -> _ => destruct (firsts r c) end; congruence.
  Qed.

  Definition placed (r : robot V) : Prop := In (place r) cells /\ In (place r) (explored r)
    /\ match doing r with Stands => True | Tries v | Enters v => In v (beside (place r)) end.
  Lemma placed_hears : forall r j said, placed r -> placed (hears r j said).
  Proof. intros r j said [A [B C]]; repeat split; auto. now apply join_left. Qed.
  Lemma placed_put : forall (f : nat -> robot V) i r, (forall j, j < N -> placed (f j)) -> placed r ->
    forall j, j < N -> placed (put f i r j).
  Proof. intros f i r S R j J; unfold put; destruct (j =? i); auto. Qed.
  Lemma placed_tells : forall f i missed, (forall j, j < N -> placed (f j)) -> forall j, j < N -> placed (tells f i missed j).
  Proof. intros f i missed S j J; unfold tells; destruct (_ || _); [auto | apply placed_hears; auto]. Qed.

  Lemma placed_always : forall rl w, sensible rl -> run rl w -> forall i, i < N -> placed (robots w i).
  Proof.
    intros rl w [Se _] R; induction R as [start w [S _] [A _] | w e w' R IH [x [E [A _]]]]; intros i I; rewrite <- A by exact I.
    { repeat split; cbn; [now apply S | apply in_map, in_seq; lia]. }
    clear A; revert i I; destruct e as [i v c missed | i missed unheard s | i missed |]; cbn [next] in E.
    - destruct (_ && _) eqn:G; [|discriminate]; injection E as <-; rewrite !andb_true_iff in G; destruct G as [[G _] X].
      apply Nat.ltb_lt in G; cbn. apply existsb_exists in X; destruct X as [[v' c'] [X Y]]; cbn in Y.
      apply andb_true_iff in Y; destruct Y as [Y Z]; apply same_spec in Y, Z; subst v' c'.
      assert (forall j, j < N -> placed (put (robots w) i (becomes (robots w i) (Tries v) (Some c)
        (waits (robots w i))) j)) as P
        by (apply placed_put; [exact IH|]; destruct (IH i G) as [B [C _]]; repeat split; cbn; eauto).
      destruct (claims rl); [now apply placed_tells | exact P].
    - destruct (doing (robots w i)) as [|v|v] eqn:D; try discriminate. destruct (i <? N) eqn:G; [|discriminate].
      destruct (s <? N); [|discriminate]; cbn [andb negb] in E; apply Nat.ltb_lt in G.
      destruct (IH i G) as [B [C P]]; rewrite D in P.
      destruct (meets w i v) as [|m met] eqn:M; [|rewrite <- M in E]; injection E as <-;
        rewrite (proj1 (settle_robots rl _)); cbn [robots with_robots].
      + destruct (obstacle v); [apply placed_tells|]; (apply placed_put; [exact IH|]); [|destruct (late _ _ _)];
          repeat split; cbn; auto.
      + assert (forall j, j < N -> placed (tells (put (robots w) i (becomes (robots w i) Stands None true)) i missed j)) as T
          by (apply placed_tells, placed_put; [exact IH | repeat split; cbn; auto]).
        apply placed_put; [exact T|]. specialize (T i G); revert T; generalize (tells (put (robots w) i (becomes
          (robots w i) Stands None true)) i missed); intros f; generalize (f i).
        induction (filter _ _) as [|k l IHl]; intros r T; cbn; [exact T | apply IHl; now apply placed_hears].
    - destruct (doing (robots w i)) as [|v|v] eqn:D; try discriminate. destruct (i <? N) eqn:G; [|discriminate].
      apply Nat.ltb_lt in G; injection E as <-; rewrite (proj1 (settle_robots rl _)); cbn.
      destruct (IH i G) as [_ [_ P]]; rewrite D in P.
      apply placed_tells, placed_put; [exact IH|]; repeat split; cbn; eauto. apply in_join; cbn; auto.
    - destruct (may_tick _ _); [|discriminate]; injection E as <-; exact IH.
  Qed.

  (** When the run ends, every robot stands, and its own map says that no way leads to a cell of which it knows nothing. *)
  Theorem sensible_knows : forall rl w, sensible rl -> run rl w -> ended rl w -> forall i, i < N ->
    doing (robots w i) = Stands
    /\ forall c, way (explored (robots w i)) c (place (robots w i)) ->
         In c (explored (robots w i)) \/ In c (blocked (robots w i)).
  Proof.
    intros rl w S R E i I; destruct (ended_all rl w R E i I) as [D W]; split; [exact D|]. intros c Wc.
    destruct (placed_always rl w S R i I) as [P [Pe _]]; unfold would in W.
    destruct (chooses rl i (robots w i)) as [|x l] eqn:C; [|discriminate]. apply (proj2 S) in C.
    destruct (has (explored (robots w i)) c) eqn:X; [left; now apply has_in|].
    destruct (has (blocked (robots w i)) c) eqn:Y; [right; now apply has_in|]. exfalso.
    assert (In c cells) as Cc by (clear - Wc beside_cells; induction Wc; eauto).
    assert (In c (targets (robots w i) (place (robots w i)))) as T; [|rewrite C in T; exact T].
    apply targets_spec; split; [exact Cc|]; rewrite <- !has_in, X, Y; split; [discriminate|]; split; [discriminate|].
    split; [intros E'; rewrite E' in Pe; apply has_in in Pe; congruence | now apply way_far].
  Qed.

  Theorem FRONTIER_4 : forall number rim rl w, rl = PLAIN \/ rl = REPAIRED number rim -> run rl w -> ended rl w -> forall i, i < N ->
    doing (robots w i) = Stands
    /\ forall c, way (explored (robots w i)) c (place (robots w i)) ->
         In c (explored (robots w i)) \/ In c (blocked (robots w i)).
  Proof. intros number rim rl w [->| ->]; apply sensible_knows; [apply plain_sensible | apply paired_sensible]. Qed.

  (** FRONTIER-1: every cell that a robot can reach is explored when the run ends: a robot was there, and it knows that. *)
  Theorem FRONTIER_1 : forall number rim rl w, rl = PLAIN \/ rl = REPAIRED number rim -> run rl w -> ended rl w -> forall i, i < N ->
    forall v, joined (place (robots w i)) v -> In v (been w) /\ In v (explored (robots w i)).
  Proof.
    intros number rim rl w H R E i I v J.
    assert (In v (explored (robots w i))) as X; [|split; [now apply (FRONTIER_5 rl w R i I) | exact X]].
    assert (In v (explored (robots w i)) /\ forall c, way (explored (robots w i)) c v ->
      way (explored (robots w i)) c (place (robots w i))) as [X _]; [|exact X].
    induction J as [|v x J [IH Ways] B O].
    - split; [|auto]. assert (sensible rl) as S by (destruct H as [->| ->]; [apply plain_sensible | apply paired_sensible]).
      now destruct (placed_always rl w S R i I) as [_ [P _]].
    - assert (In x (explored (robots w i))) as X.
      { destruct (FRONTIER_4 number rim rl w H R E i I) as [_ K]. destruct (K x) as [K'|K']; [apply Ways, way_last, B | exact K' |].
        apply (FRONTIER_5 rl w R i I) in K'; congruence. }
      split; [exact X|]. intros c W; apply Ways; eapply way_over; eauto.
  Qed.
End Area.
