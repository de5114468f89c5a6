import com.eteks.sweethome3d.io.DefaultUserPreferences;
import com.eteks.sweethome3d.io.HomeFileRecorder;
import com.eteks.sweethome3d.model.Home;
import com.eteks.sweethome3d.model.Level;
import com.eteks.sweethome3d.model.Selectable;
import com.eteks.sweethome3d.model.UserPreferences;
import com.eteks.sweethome3d.swing.PlanComponent;
import java.awt.Color;
import java.awt.Graphics2D;
import java.awt.RenderingHints;
import java.awt.geom.Rectangle2D;
import java.awt.image.BufferedImage;
import java.io.File;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import javax.imageio.ImageIO;

/**
 * Draws plans as Sweet Home 3D draws them, each level as a picture, and saves each plan anew.
 *
 * Usage: java -cp ... Draw.java FROM TO. FROM is a folder of .sh3d files; in TO are NAME.LEVEL.png, which
 * has a pixel for each centimetre, and NAME.sh3d, as "File > Save as" writes it. Says a line for
 * each level: name, tab, picture, tab, what the level is called.
 */
public class Draw {
    private static final float PIXELS_PER_CM = 1;
    private static final float MARGIN_CM = 60;
    private static final Color INK = Color.BLACK;
    private static final Color PAPER = Color.WHITE;

    public static void main(String[] said) throws Exception {
        File[] files = new File(said[0]).listFiles((folder, name) -> name.endsWith(".sh3d"));
        Arrays.sort(files);
        UserPreferences preferences = new DefaultUserPreferences();
        preferences.setFurnitureViewedFromTop(true);
        preferences.setFloorColoredOrTextured(false);
        for (File file : files) {
            String name = file.getName().replaceAll("\\.sh3d$", "");
            HomeFileRecorder recorder = new HomeFileRecorder(9, false, preferences, false, true);
            Home home = recorder.readHome(file.getPath());
            recorder.writeHome(home, new File(said[1], name + ".sh3d").getPath());
            List<Level> levels = new ArrayList<>(home.getLevels());
            if (levels.isEmpty()) {
                levels.add(null);
            }
            for (int index = 0; index < levels.size(); index++) {
                Level level = levels.get(index);
                BufferedImage picture = drawn(home, level, preferences);
                if (picture == null) {
                    continue;
                }
                File to = new File(said[1], name + "." + index + ".png");
                ImageIO.write(picture, "png", to);
                System.out.println(name + "\t" + to.getName() + "\t" + (level == null ? "" : level.getName()));
            }
        }
        System.exit(0);
    }

    /** The plan of a level, or nothing where nothing is drawn on it. */
    private static BufferedImage drawn(Home home, Level level, UserPreferences preferences) throws Exception {
        home.setAllLevelsSelection(false);
        if (level != null) {
            home.setSelectedLevel(level);
        }
        List<Selectable> items = new ArrayList<>();
        home.getWalls().stream().filter(wall -> wall.isAtLevel(level)).forEach(items::add);
        home.getRooms().stream().filter(room -> room.isAtLevel(level)).forEach(items::add);
        Rectangle2D bounds = null;
        for (Selectable item : items) {
            for (float[] point : item.getPoints()) {
                Rectangle2D at = new Rectangle2D.Float(point[0], point[1], 0, 0);
                bounds = bounds == null ? at : bounds.createUnion(at);
            }
        }
        if (bounds == null) {
            return null;
        }
        int width = (int) ((bounds.getWidth() + 2 * MARGIN_CM) * PIXELS_PER_CM);
        int height = (int) ((bounds.getHeight() + 2 * MARGIN_CM) * PIXELS_PER_CM);
        BufferedImage picture = new BufferedImage(width, height, BufferedImage.TYPE_INT_RGB);
        Graphics2D pen = picture.createGraphics();
        pen.setRenderingHint(RenderingHints.KEY_ANTIALIASING, RenderingHints.VALUE_ANTIALIAS_ON);
        pen.setColor(PAPER);
        pen.fillRect(0, 0, width, height);
        pen.scale(PIXELS_PER_CM, PIXELS_PER_CM);
        pen.translate(MARGIN_CM - bounds.getX(), MARGIN_CM - bounds.getY());
        new Plan(home, preferences).draw(pen);
        pen.dispose();
        return picture;
    }

    /** Sweet Home 3D's own drawing of a plan. */
    private static class Plan extends PlanComponent {
        Plan(Home home, UserPreferences preferences) {
            super(home, preferences, null);
        }

        void draw(Graphics2D pen) throws Exception {
            paintHomeItems(pen, PIXELS_PER_CM, PAPER, INK, PaintMode.EXPORT);
        }
    }
}
